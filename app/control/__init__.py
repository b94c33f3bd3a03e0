"""Who drives a rig, and the rules of the laboratory about driving and approving: both are switched off at first."""
