"""What the project is built from: its parts, their licences and known vulnerabilities, and the list of them (SBOM)."""
