# Where fits spend their time (scripts/bench): compiled for speed, all else for the time or size of compiled code.
set(loops_of_numerics
    criteria/ filters/ fit/recursive/ linalg/ signals/ simulation/ statistics/
    estimators/frequency/bla.cpp fit/equation_error.cpp fit/output_error.cpp fit/simulation_error.cpp fit/srivc_iteration.cpp
    models/called_equations.cpp models/expression.cpp models/free_run.cpp models/sampled_system.cpp models/traced_equations.cpp
    validation/compare.cpp validation/prediction.cpp validation/residual_tests.cpp)
