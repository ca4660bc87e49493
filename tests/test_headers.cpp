// GoogleTest is precompiled here once for all tests.
#include <gtest/gtest.h>
