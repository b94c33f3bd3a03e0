"""Preflight of plans: a dry run and the stability prediction, in a process of their own."""
