"""Checks that pages print the stored figures and state orderings that hold; tools/check_figures is its command."""
