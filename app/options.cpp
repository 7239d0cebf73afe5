// Grows with the command line.
