"""Accounts: who may sign in, with which role, by which sessions and API tokens."""
