"""Events for people and for other programs, by REST and by webhooks."""
