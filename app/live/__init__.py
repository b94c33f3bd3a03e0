"""The live stream: frames from workers to browsers."""
