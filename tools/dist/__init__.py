"""What the downloads of `make dist` hold, and how they are packed."""
