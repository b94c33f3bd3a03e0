"""Monitoring: whether the service is ready, and metrics for Prometheus."""
