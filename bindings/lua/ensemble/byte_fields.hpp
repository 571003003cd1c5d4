// SPDX-License-Identifier: GPL-3.0-or-later
// Structs as bytes; one list of members for both directions.
#pragma once

#include <concepts>
#include <ranges>
#include <string>
#include <tuple>
#include <type_traits>

#include "bindings/lua/ensemble/ensemble_case.hpp"
#include "engine/core/files/byte_string.hpp"
#include "engine/surface/material.hpp"

namespace asperity::lua {

template <class T>
auto members(T& of) {
  using Struct = std::remove_const_t<T>;
  if constexpr (std::same_as<Struct, Dimension>)
    return std::tie(of.length, of.mass, of.time, of.angle);
  else if constexpr (std::same_as<Struct, Grid>)
    return std::tie(of.nx, of.ny, of.size_x, of.size_y);
  else if constexpr (std::same_as<Struct, Material>)
    return std::tie(of.name, of.young, of.poisson, of.hardness, of.density, of.source, of.rigid);
  else if constexpr (std::same_as<Struct, RunKnob>)
    return std::tie(of.name, of.from, of.to, of.value, of.log, of.dimension);
  else if constexpr (std::same_as<Struct, CaseInput>)
    return std::tie(of.file, of.bytes, of.digest, of.beside_script, of.loaded);
  else if constexpr (std::same_as<Struct, CaseResult>)
    return std::tie(of.digest, of.failure, of.output, of.warnings, of.inputs, of.knobs, of.drew,
                    of.transforms, of.seconds);
  else
    return std::tie(of.first, of.second);
}

// Numbers, texts, optionals, vectors, and structs with members().
template <class T>
void write_fields(ByteWriter& out, const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    out.number(value);
  } else if constexpr (std::same_as<T, std::string>) {
    out.text(value);
  } else if constexpr (requires { value.has_value(); }) {
    out.number(value.has_value());
    if (value) write_fields(out, *value);
  } else if constexpr (std::ranges::range<T>) {
    out.count(value.size());
    for (const auto& item : value) write_fields(out, item);
  } else {
    std::apply([&](const auto&... parts) { (write_fields(out, parts), ...); }, members(value));
  }
}
// Throws Error{bad_file}.
template <class T>
void read_fields(ByteReader& in, T& value) {
  if constexpr (std::same_as<T, bool>) {
    value = in.truth();
  } else if constexpr (std::is_arithmetic_v<T>) {
    value = in.number<T>();
  } else if constexpr (std::same_as<T, std::string>) {
    value = in.text();
  } else if constexpr (requires { value.has_value(); }) {
    if (in.truth()) read_fields(in, value.emplace());
  } else if constexpr (std::ranges::range<T>) {
    for (std::size_t left = in.count(); left > 0; --left) read_fields(in, value.emplace_back());
  } else {
    std::apply([&](auto&... parts) { (read_fields(in, parts), ...); }, members(value));
  }
}

}  // namespace asperity::lua
