"""Library of plans: versions under a name, drafts, tags, comparison and history."""
