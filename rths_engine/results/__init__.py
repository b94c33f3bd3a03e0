"""What a run leaves: channels, signals and the measures of them."""
