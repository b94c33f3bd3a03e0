"""The library of ground motions."""
