"""The audit log for people: list, check, head and export."""
