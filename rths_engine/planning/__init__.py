"""The test plan: its fields, its checks, its YAML form and the templates."""
