"""Text and JSON without a format of their own."""
