# Programs of the engine tests that are not cmocka programs.
