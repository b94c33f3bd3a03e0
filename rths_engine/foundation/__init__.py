"""Quantities with units, errors, files, compilation and the declaration of parts. Every other room uses this one."""
