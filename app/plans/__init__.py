"""Plans: checks, previews and templates."""
