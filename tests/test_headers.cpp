// Nothing: this file stands for the options that the tests' precompiled header is made with.
