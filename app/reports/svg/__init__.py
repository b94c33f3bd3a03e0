"""Figures as SVG text: the same drawing in an HTML report, where a style sheet colours it, and in a PDF."""
