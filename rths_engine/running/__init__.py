"""The compiled loop, and the code that prepares it, runs it and replays single parts."""
