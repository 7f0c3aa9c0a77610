"""Numbers of records and of many runs: rotation of disks, means with errors, bootstrap."""
