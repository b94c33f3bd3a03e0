"""Annotations: notes of people at times of a run, made on its charts and shown in its reports."""
