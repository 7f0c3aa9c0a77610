"""FMUs of jostle through fmpy: one wrapper for FMI 2.0 and FMI 3.0, and what each scene adds to it."""
