"""What bounds the work of each route. A new route joins one of these groups; tests/app/test_bounds.py looks after them.

No request may do unbounded work on the threads that all requests share, or on the event loop: where the processor time of a
route follows from its input and may exceed about 0.1 s, its work is a calculation.
"""

from __future__ import annotations

# In a process with bounds of time and memory (app/calculations), whose answer is the response.
PROCESS = """
GET /api/v1/runs/table.csv
GET /api/v1/runs/{run_id}/recording.csv
GET /api/v1/runs/{run_id}/plan.yaml
POST /api/v1/sweeps/fields
GET /api/v1/sweeps/{sweep_id}/results
GET /api/v1/sweeps/{sweep_id}/fragility
GET /api/v1/sweeps/{sweep_id}/sensitivity
POST /api/v1/motions
POST /api/v1/motions/contents
POST /api/v1/motions/preview
GET /api/v1/motions/{name}/preview
POST /api/v1/plans/check
POST /api/v1/plans/drive
POST /api/v1/plans/read
POST /api/v1/plans/write
POST /api/v1/plans/preflight
POST /api/v1/plans/identify
POST /api/v1/library/import
GET /api/v1/library/plans/{plan_id}/versions/{version}/plan.yaml
GET /api/v1/library/differences
GET /api/v1/compare
GET /api/v1/compare/signals
POST /api/v1/stability
GET /api/v1/audit/check
GET /api/v1/audit/export
GET /api/v1/runs/{run_id}/report.html
GET /api/v1/runs/{run_id}/report.pdf
GET /api/v1/runs/{run_id}/recording.mat
POST /api/v1/runs/{run_id}/designsafe/check
POST /api/v1/runs/{run_id}/designsafe.zip
GET /api/v1/diagnoses/{diagnosis_id}/report.html
GET /api/v1/diagnoses/{diagnosis_id}/report.pdf
GET /api/v1/compare/report.html
GET /api/v1/compare/report.pdf
GET /api/v1/sweeps/{sweep_id}/report.html
GET /api/v1/sweeps/{sweep_id}/report.pdf
GET /api/v1/recordings/files/{sha256}
POST /api/v1/recordings/preview
GET /api/v1/recordings/{recording_id}/preview
GET /diagnoses/{diagnosis_id}
GET /compare
"""

# The part that follows from the input is computed in such a process; the service goes on with its result.
PROCESS_IN_SERVICE = """
POST /api/v1/runs
POST /api/v1/runs/{run_id}/retry
POST /api/v1/sweeps/preview
POST /api/v1/sweeps
POST /api/v1/sweeps/{sweep_id}/points/{point}/run
POST /api/v1/library/plans
POST /api/v1/library/plans/{plan_id}/versions
POST /api/v1/library/plans/{plan_id}/duplicate
POST /api/v1/mappings
POST /api/v1/diagnoses
POST /api/v1/diagnoses/{diagnosis_id}/simulations
POST /api/v1/table4
POST /api/v1/recordings/batches
POST /api/v1/recordings/files
POST /api/v1/recordings
"""

# Follows from one row or body, whose size is bounded: json_limit, or the limit of the file.
SIZE = """
POST /api/v1/runs/bulk
GET /api/v1/runs/{run_id}
GET /api/v1/sweeps/{sweep_id}
GET /api/v1/sweeps/{sweep_id}/points/{point}
GET /api/v1/library/plans/{plan_id}/versions/{version}
GET /api/v1/library/drafts/{draft_id}
PUT /api/v1/library/drafts/{draft_id}
GET /api/v1/mappings/{mapping_id}/mapping.yaml
GET /api/v1/diagnoses/{diagnosis_id}
GET /api/v1/diagnoses/{diagnosis_id}/verdict.json
GET /api/v1/diagnoses/{diagnosis_id}/pictures.json
PUT /api/v1/laboratory/logo
GET /api/v1/recordings/batches/{batch_id}
GET /api/v1/recordings/batches/{batch_id}/table.csv
GET /api/v1/recordings/{recording_id}/mapping.yaml
"""

# The same for every request: declared by the program, most of it made once.
FIXED = """
GET /openapi.json
GET /api/v1/sweeps/schema
GET /api/v1/templates
GET /api/v1/templates/{name}
GET /api/v1/schema
GET /api/v1/diagnoses/schema
GET /api/v1/diagnoses/pictures-schema
GET /api/v1/league
GET /healthz
GET /livez
GET /api/v1/glossary
GET /api/v1/recordings/roles
GET /api/docs
GET /help
GET /help/{name:path}
"""

# A stored file, sent in parts as the client takes them.
FILE = """
GET /api/v1/runs/{run_id}/recording.h5
GET /static/plotly.min.js
GET /api/v1/laboratory/logo
GET /api/v1/recordings/{recording_id}/recording.h5
GET /api/v1/recordings/{recording_id}/raw
MOUNT /static/{path:path}
"""

# One message at a time, and frames that slow viewers skip: app/live.
SOCKET = """
websocket /api/v1/worker
websocket /api/v1/runs/{run_id}/live
"""

# Rows along an index, at most a page of them (tests/app/test_run_table.py, docs/scale.md), or one row that changes.
ROWS = """
GET /api/v1/runs/columns
GET /api/v1/runs/table
GET /api/v1/runs/views
POST /api/v1/runs/views
DELETE /api/v1/runs/views/{view_id}
GET /api/v1/runs/tags
PATCH /api/v1/runs/{run_id}
DELETE /api/v1/runs/{run_id}
POST /api/v1/runs/{run_id}/restore
GET /api/v1/runs
POST /api/v1/runs/{run_id}/cancel
POST /api/v1/runs/{run_id}/undo-cancel
GET /api/v1/runs/{run_id}/measures.csv
GET /api/v1/sweeps
POST /api/v1/sweeps/{sweep_id}/cancel
POST /api/v1/sweeps/{sweep_id}/resume
DELETE /api/v1/sweeps/{sweep_id}
GET /api/v1/queue
POST /api/v1/queue/order
POST /api/v1/queue/priority
POST /api/v1/queue/cancel
POST /api/v1/queue/hold
POST /api/v1/queue/release
POST /api/v1/abort
GET /api/v1/abort
GET /api/v1/rigs
POST /api/v1/rigs
GET /api/v1/rigs/{rig_id}
PUT /api/v1/rigs/{rig_id}
DELETE /api/v1/rigs/{rig_id}
GET /api/v1/rules
PUT /api/v1/rules
GET /api/v1/control
POST /api/v1/control/{rig_id}/take
POST /api/v1/control/{rig_id}/renew
POST /api/v1/control/{rig_id}/release
POST /api/v1/control/{rig_id}/request
POST /api/v1/control/{rig_id}/hand-over
POST /api/v1/control/{rig_id}/take-over
GET /api/v1/approvals
POST /api/v1/approvals/{about_id}/approve
POST /api/v1/approvals/{about_id}/reject
GET /api/v1/retention
PUT /api/v1/retention
GET /api/v1/retention/preview
GET /api/v1/motions
GET /api/v1/motions/{name}
DELETE /api/v1/motions/{name}
GET /api/v1/library/plans
GET /api/v1/library/plans/{plan_id}
PATCH /api/v1/library/plans/{plan_id}
POST /api/v1/library/plans/{plan_id}/archive
POST /api/v1/library/plans/{plan_id}/unarchive
GET /api/v1/library/plans/{plan_id}/runs
GET /api/v1/library/drafts
POST /api/v1/library/drafts/{draft_id}/close
POST /api/v1/library/drafts/{draft_id}/reopen
GET /api/v1/mappings
GET /api/v1/mappings/{mapping_id}
PATCH /api/v1/mappings/{mapping_id}
DELETE /api/v1/mappings/{mapping_id}
GET /api/v1/diagnoses
POST /api/v1/diagnoses/{diagnosis_id}/cancel
DELETE /api/v1/diagnoses/{diagnosis_id}
GET /api/v1/compare/candidates
GET /api/v1/compare/previous/{run_id}
GET /api/v1/table4
GET /api/v1/laboratory
PUT /api/v1/laboratory
DELETE /api/v1/laboratory/logo
GET /api/v1/events
GET /api/v1/webhooks
POST /api/v1/webhooks
PATCH /api/v1/webhooks/{webhook_id}
POST /api/v1/webhooks/{webhook_id}/test
GET /api/v1/webhooks/{webhook_id}/deliveries
DELETE /api/v1/webhooks/{webhook_id}
GET /api/v1/audit
GET /api/v1/audit/head
GET /readyz
GET /metrics
POST /api/v1/sign-in
POST /api/v1/sign-out
POST /api/v1/sign-in/link/read
POST /api/v1/sign-in/link
GET /api/v1/account
POST /api/v1/account/password
GET /api/v1/account/sessions
DELETE /api/v1/account/sessions
DELETE /api/v1/account/sessions/{session_id}
GET /api/v1/account/tokens
POST /api/v1/account/tokens
DELETE /api/v1/account/tokens/{token_id}
GET /api/v1/accounts
POST /api/v1/accounts
PATCH /api/v1/accounts/{account_id}
POST /api/v1/accounts/{account_id}/password-link
GET /api/v1/accounts/{account_id}/tokens
DELETE /api/v1/accounts/{account_id}/tokens/{token_id}
GET /api/v1/runs/{run_id}/annotations
POST /api/v1/runs/{run_id}/annotations
PUT /api/v1/runs/{run_id}/annotations/{annotation_id}
DELETE /api/v1/runs/{run_id}/annotations/{annotation_id}
GET /api/v1/recordings/batches
GET /api/v1/recordings/mappings
GET /api/v1/recordings
GET /api/v1/recordings/{recording_id}
DELETE /api/v1/recordings/{recording_id}
GET /sign-in
GET /sign-in/link
GET /account
POST /sign-out
GET /stability
GET /stability/{name}
GET /recordings/batches/{batch_id}
GET /recordings
GET /recordings/{recording_id}
GET /plans
GET /plans/{plan_id}
GET /diagnoses
GET /compare/previous/{run_id}
GET /
GET /lab
GET /lab/since
GET /league
GET /table4
GET /table4/now
GET /sweeps
GET /sweeps/new
GET /sweeps/{sweep_id}
GET /wall
GET /audit
GET /settings
GET /runs/{run_id}/designsafe
GET /queue
GET /new
GET /runs
GET /runs/{run_id}
GET /{path:page}
"""

GROUPS = {
    name: text.split("\n")[1:-1]
    for name, text in {
        "process": PROCESS,
        "process in service": PROCESS_IN_SERVICE,
        "size": SIZE,
        "fixed": FIXED,
        "file": FILE,
        "socket": SOCKET,
        "rows": ROWS,
    }.items()
}
