"""Retention: recordings of runs are removed by a rule of the laboratory; rows, plans and measures stay. Off at first."""
