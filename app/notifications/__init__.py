"""What people and their other programs are told of: events by REST and by webhooks."""
