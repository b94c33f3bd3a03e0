"""The compiled loop and everything that prepares it, runs it and replays one part of it."""
