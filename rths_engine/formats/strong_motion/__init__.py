"""Formats of strong-motion networks."""
