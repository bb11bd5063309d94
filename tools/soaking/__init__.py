"""The parts of tools/soak: how the program is run, what is tried, and what counts as a finding."""
