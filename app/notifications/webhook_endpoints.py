"""REST endpoints of webhooks."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Depends
from fastapi.responses import Response

from app.access import Role, allowed
from app.dependencies import OneSession
from app.notifications.schemas import DeliveryList, DeliveryOut, WebhookAdded, WebhookChange, WebhookIn, WebhookList, WebhookOut
from app.notifications.webhooks import WebhookService

router = APIRouter(prefix="/api/v1/webhooks", tags=["notifications"])


def webhook_service(session: OneSession) -> WebhookService:
    """The service of webhooks in the session of the request."""
    return WebhookService(session)


Webhooks = Annotated[WebhookService, Depends(webhook_service)]


@router.get("")
@allowed(Role.ADMINISTRATOR)
def listed(webhooks: Webhooks) -> WebhookList:
    """List the webhooks with their latest delivery. Secrets are not shown."""
    return WebhookList(webhooks=webhooks.listed())


@router.post("", status_code=201)
@allowed(Role.ADMINISTRATOR)
def add(given: Annotated[WebhookIn, Body()], webhooks: Webhooks) -> WebhookAdded:
    """Add a webhook: an address to which events of some kinds are sent as signed JSON. The secret is shown only now."""
    return webhooks.add(given)


@router.patch("/{webhook_id}")
@allowed(Role.ADMINISTRATOR)
def change(webhook_id: str, given: Annotated[WebhookChange, Body()], webhooks: Webhooks) -> WebhookOut:
    """Change the address or the kinds of a webhook, or pause it with `enabled: false`."""
    return webhooks.change(webhook_id, given)


@router.post("/{webhook_id}/test", status_code=201)
@allowed(Role.ADMINISTRATOR)
def test(webhook_id: str, webhooks: Webhooks) -> DeliveryOut:
    """Send a test to a webhook within about a second. The log of its deliveries shows the answer."""
    return webhooks.test(webhook_id)


@router.get("/{webhook_id}/deliveries")
@allowed(Role.ADMINISTRATOR)
def deliveries(webhook_id: str, webhooks: Webhooks) -> DeliveryList:
    """List the latest 50 deliveries of a webhook with attempts, status and problem, newest first."""
    return DeliveryList(deliveries=webhooks.deliveries(webhook_id))


@router.delete("/{webhook_id}", status_code=204, response_class=Response)
@allowed(Role.ADMINISTRATOR)
def remove(webhook_id: str, webhooks: Webhooks) -> None:
    """Delete a webhook with the log of its deliveries."""
    webhooks.remove(webhook_id)
