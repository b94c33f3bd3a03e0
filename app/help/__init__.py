"""The documents of the program, shown and searched inside it, and the glossary behind labels."""
