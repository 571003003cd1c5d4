// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/program_identity.hpp"

#include <gtest/gtest.h>

#include "engine/core/arithmetic/register_vectors.hpp"

namespace asperity::program_identity_test {
namespace {

TEST(VectorWidth, IsThatOfARegister) { EXPECT_EQ(vector_bytes(), register_bytes); }

TEST(VectorWidth, Is64BytesFromLevel4On) { EXPECT_EQ(vector_bytes() == 64, vector_level() == "x86-64-v4"); }

}  // namespace
}  // namespace asperity::program_identity_test
