"""Quantities with units, errors, files, compilation and the declaration of parts: what every other room stands on."""
