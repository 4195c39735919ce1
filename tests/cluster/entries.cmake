# Slurm and sshd have ports of their own: one such entry at a time, whatever the number of processors. Labels are matched
# by parts of their names: -L cluster takes all of these, and -LE long leaves out those of hours.
set_tests_properties(loopback gust storm PROPERTIES RESOURCE_LOCK loopback)
set_tests_properties(loopback gust PROPERTIES LABELS cluster-engines)
set_tests_properties(storm PROPERTIES LABELS cluster-long PROCESSORS 2 TIMEOUT 10800)
