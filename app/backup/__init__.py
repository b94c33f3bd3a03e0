"""Backups: a consistent copy of rows and files while the service runs, its restoration, and the check of what is stored."""
