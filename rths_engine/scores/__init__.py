"""Published scores: models fitted to published measurements and scored on the published split, beside the published figure."""
