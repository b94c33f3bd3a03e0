"""Plans: check, preview and templates."""
