"""Numerics of real-time hybrid simulation: plans, parts, the compiled loop, recordings and measures. SI units inside."""

__version__ = "0.1.0"
