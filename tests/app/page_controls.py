"""What the pages send, the route that it reaches where the script composes the address, and the controls that send it.

A control is an element of a template, `queue.html#release`, or a line of a script, `queue/waiting.js class: "acts"`. It or an
element around it says in `data-needs` the role that the route needs: tests/app/test_page_roles.py.
"""

from __future__ import annotations

KEPT = "library/plan_page.js"

CONTROLS: dict[tuple[str, str], tuple[tuple[str, ...], tuple[str, ...]]] = {
    # (script, call as written): (routes, none where the call names its route), (controls)
    ("control/line.js", "POST `/control/${rig.rig_id}/${what}`"): (
        tuple(f"POST /control/1/{what}" for what in ("take", "request", "release", "hand-over")),
        ("control/line.js needs = ",),
    ),
    ("control/line.js", "POST `/control/${rig.rig_id}/renew`"): ((), ("control/line.js needs = ",)),
    ("diagnoses/diagnosis.js", "POST `/diagnoses/${id}/cancel`"): ((), ("diagnosis.html#cancel",)),
    ("diagnoses/diagnosis.js", "POST `/diagnoses/${id}/simulations`"): ((), ("diagnosis.html#simulate",)),
    ("diagnoses/diagnosis.js", "DELETE `/diagnoses/${id}`"): ((), ("diagnosis.html#remove",)),
    ("diagnoses/form.js", 'POST "/diagnoses"'): ((), ("diagnoses.html#submit",)),
    ("form/new_test.js", 'POST "/runs"'): ((), ("new.html#submit", 'form/new_test.js may("operator")')),
    ("form/upload.js", 'POST "/motions"'): ((), ('form/upload.js class: "upload"',)),
    ("lab/lab.js", "POST button.dataset.post"): (
        ("POST /queue/release", "POST /runs/1/cancel"),
        ("lab_now.html#release", "lab_now.html#cancel-"),
    ),
    ("lab/lab.js", 'POST "/runs"'): (
        ("POST /library/plans",),
        ("lab_tour.html#tour-start",),
    ),  # a plan that the library does not hold
    ("library/draft.js", "POST `/library/drafts/${id}/close`"): ((), ("new.html#draft",)),
    ("library/draft.js", "POST `/library/drafts/${id}/reopen`"): ((), ("new.html#draft",)),
    ("library/draft.js", "PUT `/library/drafts/${id}`"): ((), ('library/draft.js may("engineer")',)),
    ("library/draft_rows.js", "POST `/library/drafts/${id}/close`"): ((), ("plans.html#drafts",)),
    ("library/draft_rows.js", "POST `/library/drafts/${id}/reopen`"): ((), ("plans.html#drafts",)),
    (KEPT, 'POST `${path}/${archived_at ? "unarchive" : "archive"}`'): (
        ("POST /library/plans/1/archive", "POST /library/plans/1/unarchive"),
        ("plan.html#archive",),
    ),
    (KEPT, "POST `${path}/unarchive`"): (("POST /library/plans/1/unarchive",), ("plan.html#archive",)),
    (KEPT, "PATCH path"): (("PATCH /library/plans/1",), ("plan.html#change-form",)),
    (KEPT, "POST `${path}/duplicate`"): (("POST /library/plans/1/duplicate",), ("plan.html#duplicate",)),
    ("library/plan_rows.js", "POST `/library/plans/${id}/duplicate`"): ((), ('library/plan_rows.js rowButton("Duplicate"',)),
    ("library/plan_rows.js", "POST `/library/plans/${id}/archive`"): ((), ('library/plan_rows.js rowButton("Archive"',)),
    ("library/plan_rows.js", "POST `/library/plans/${id}/unarchive`"): ((), ('library/plan_rows.js rowButton("Unarchive"',)),
    ("library/plans_page.js", "POST `/library/import?saved_by=${encodeURIComponent(person())}`"): ((), ("plans.html#import",)),
    ("library/queue_dialog.js", 'POST "/runs"'): (
        (),
        ("plan.html#queue", 'library/plan_rows.js rowButton("Queue"', 'library/versions.js rowButton("Queue"'),
    ),
    ("library/save_dialog.js", "POST `/library/plans/${library.id}/versions`"): ((), ("new.html#keep",)),
    ("library/save_dialog.js", 'POST "/library/plans"'): ((), ("new.html#keep",)),
    ("queue/approvals.js", "POST `/approvals/${one.id}/${what}`"): (
        ("POST /approvals/1/approve", "POST /approvals/1/reject"),
        ('queue/approvals.js button("Approve"',),
    ),
    ("queue/approvals.js", "POST `/runs/${one.id}/cancel`"): ((), ("queue/approvals.js api.post(`/runs/",)),
    ("queue/approvals.js", "POST `/sweeps/${one.id}/cancel`"): ((), ("queue/approvals.js api.post(`/sweeps/",)),
    ("queue/page.js", "POST path"): (
        tuple(f"POST /queue/{what}" for what in ("order", "priority", "hold", "release")),
        (
            "queue.html#hold-form",
            "queue.html#release",
            "queue.html#bulk",
            "queue.html#select-all",
            'queue/waiting.js class: "grip"',
            "queue/waiting.js acts.priority(one.id",
            'queue/waiting.js class: "acts"',
        ),
    ),
    ("queue/page.js", 'POST "/queue/cancel"'): ((), ("queue.html#bulk", 'queue/waiting.js class: "acts"')),
    ("queue/page.js", "POST `/runs/${run}/undo-cancel`"): ((), ('queue/page.js "data-undo"',)),
    ("queue/page.js", "POST `/runs/${id}/cancel`"): ((), ('queue/running.js class: "acts"',)),
    ("recordings/editor.js", 'POST "/recordings/preview"'): ((), ("recordings.html#work",)),
    ("recordings/editor.js", 'POST "/recordings"'): ((), ("recordings.html#work",)),
    ("recordings/many.js", 'POST "/recordings/batches"'): ((), ("recordings_many.html#many",)),
    ("recordings/page.js", 'POST "/recordings/files"'): ((), ("recordings.html#drop",)),
    ("recordings/remove.js", "DELETE `/recordings/${button.dataset.remove}`"): ((), ("macros.html[data-remove]",)),
    ("recordings/saved_list.js", "PATCH `/mappings/${id}`"): ((), ('recordings/saved_list.js button("Rename"',)),
    ("recordings/saved_list.js", "DELETE `/mappings/${id}`"): ((), ('recordings/saved_list.js button("Delete"',)),
    ("recordings/saving.js", 'POST "/mappings"'): ((), ("recordings.html#work",)),
    ("run/again.js", "POST `/runs/${run.id}/${path}`"): (
        ("POST /runs/1/retry", "POST /runs/1/undo-cancel"),
        ('run/again.js el("button"',),
    ),
    ("run/annotations.js", "POST this.address"): (
        ("POST /runs/1/annotations",),
        ('run/annotations.js el("button", { type: "button", class: "quiet",', 'run/annotations.js may("engineer")'),
    ),
    ("run/annotations.js", "PUT `${this.address}/${note.id}`"): (
        ("PUT /runs/1/annotations/1",),
        ("run/annotations.js `Edit annotation",),
    ),
    ("run/annotations.js", "DELETE `${this.address}/${note.id}`"): (
        ("DELETE /runs/1/annotations/1",),
        ("run/annotations.js `Delete annotation",),
    ),
    ("run/run.js", "POST `/runs/${id}/cancel`"): ((), ('run/actions.js "Cancel this test"',)),
    ("runs/about.js", "PATCH `/runs/${run.id}`"): ((), ('runs/about.js may("engineer")',)),
    ("runs/actions.js", 'POST "/runs/bulk"'): (
        (),
        ("runs/runs.js const button =", "runs/panel.js const button ="),
    ),
    ("runs/on_run_page.js", "POST `/runs/${id}/restore`"): ((), ('runs/on_run_page.js el("button"',)),
    ("runs/on_run_page.js", "PATCH `/runs/${id}`"): ((), ('runs/on_run_page.js el("button"',)),
    ("runs/saved_views.js", 'POST "/runs/views"'): ((), ("runs.html#view-save",)),
    ("runs/saved_views.js", "DELETE `/runs/views/${one.id}`"): ((), ("runs.html#view-delete",)),
    ("settings/accounts.js", "PATCH path"): (("PATCH /accounts/1",), ("settings_accounts.html#account-rows",)),
    ("settings/accounts.js", "POST `${path}/password-link`"): (
        ("POST /accounts/1/password-link",),
        ("settings_accounts.html#account-rows",),
    ),
    ("settings/accounts.js", 'POST "/accounts"'): ((), ("settings_accounts.html#account-form",)),
    ("settings/designsafe.js", "POST `${address}/check`"): (("POST /runs/1/designsafe/check",), ()),
    ("settings/laboratory.js", 'PUT "/laboratory"'): ((), ("settings_laboratory.html#laboratory-save",)),
    ("settings/laboratory.js", 'PUT "/laboratory/logo"'): ((), ("settings_laboratory.html#logo-file",)),
    ("settings/laboratory.js", 'DELETE "/laboratory/logo"'): ((), ("settings_laboratory.html#logo-remove",)),
    ("settings/retention.js", 'PUT "/retention"'): ((), ("settings_retention.html#retention-form",)),
    ("settings/rigs.js", "PUT `/rigs/${rig.id}`"): ((), ('settings/rigs.js { "data-needs"',)),
    ("settings/rigs.js", "DELETE `/rigs/${rig.id}`"): ((), ('settings/rigs.js { "data-needs"',)),
    ("settings/rigs.js", "PUT `/rigs/${id}`"): ((), ("settings_rigs.html#rig-form",)),
    ("settings/rigs.js", 'POST "/rigs"'): ((), ("settings_rigs.html#rig-form",)),
    ("settings/rules.js", 'PUT "/rules"'): ((), ("settings_rules.html#rules-save",)),
    ("settings/webhooks.js", "POST `/webhooks/${hook.id}/test`"): ((), ("settings_webhooks.html#webhook-rows",)),
    ("settings/webhooks.js", "PATCH `/webhooks/${hook.id}`"): ((), ("settings_webhooks.html#webhook-rows",)),
    ("settings/webhooks.js", "DELETE `/webhooks/${hook.id}`"): ((), ("settings_webhooks.html#webhook-rows",)),
    ("settings/webhooks.js", 'POST "/webhooks"'): ((), ("settings_webhooks.html#webhook-form",)),
    ("sweeps/chosen.js", "POST `/sweeps/${this.sweep}/points/${point}/run`"): ((), ("sweeps/chosen.js `Run point",)),
    ("sweeps/new.js", 'POST "/sweeps"'): ((), ("sweep_new.html#queue",)),
    ("sweeps/page.js", "POST `${address}/${what}`"): (
        ("POST /sweeps/1/cancel", "POST /sweeps/1/resume"),
        ('sweeps/page.js const button = el("button"',),
    ),
    ("table4.js", 'POST "/table4"'): ((), ("table4.html#queue-all",)),
}
