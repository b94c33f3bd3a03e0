"""The command line `rths`: one command a file."""
