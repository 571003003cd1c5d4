// SPDX-License-Identifier: GPL-3.0-or-later
// The trace of a heavy call in journal and ledger. The digest of its results: native values by their digests;
// records, lists and tables by all numbers, booleans and texts; no costs, which vary.
#pragma once

#include <string>

#include "bindings/lua/registry/options.hpp"

namespace asperity::lua {

class Session;

std::string digest_of(const Object& object);
// "" without a value and for texts only (paths of files).
std::string digest_of(const Values& results);

// Writes the journal line of a heavy call or an iterator's turn: object before the colon (may be null),
// inputs, digest of the results.
void record_call(const Session& session, const std::string& function, const Object* self,
                 const Resolved& inputs, const Values& results);

void enter_into_ledger(const Session& session, const Values& results);

}  // namespace asperity::lua
