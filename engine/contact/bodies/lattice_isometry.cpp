// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/bodies/lattice_isometry.hpp"

#include <string>

#include "engine/core/error.hpp"

namespace asperity {

namespace {
int modulo(long long value, int n) {
  const long long rest = value % n;
  return static_cast<int>(rest < 0 ? rest + n : rest);
}
}  // namespace

LatticeIsometry::LatticeIsometry(int nx, int ny) : nx_(nx), ny_(ny) {}

LatticeIsometry::Node LatticeIsometry::turn(Node node, int quarters) const {
  switch (quarters) {
    case 1:
      return {ny_ - 1 - node.j, node.i};
    case 2:
      return {nx_ - 1 - node.i, ny_ - 1 - node.j};
    case 3:
      return {node.j, nx_ - 1 - node.i};
    default:
      return node;
  }
}

LatticeIsometry LatticeIsometry::turned(int quarters) const {
  const int turns = modulo(quarters, 4);
  if (turns % 2 != 0 && nx_ != ny_)
    throw Error(ErrorCode::bad_value,
                "a turn by " + std::to_string(turns * 90) + " deg was asked of a grid of " +
                    std::to_string(nx_) + " x " + std::to_string(ny_) + " cells",
                "only a square tile can be turned by 90 deg; this one can be turned by 180 deg");
  LatticeIsometry result = *this;
  result.quarters_ = modulo(quarters_ + turns, 4);
  // turn ∘ shift(s) = shift(R s) ∘ turn
  switch (turns) {
    case 1:
      result.shift_x_ = modulo(-shift_y_, nx_);
      result.shift_y_ = shift_x_;
      break;
    case 2:
      result.shift_x_ = modulo(-shift_x_, nx_);
      result.shift_y_ = modulo(-shift_y_, ny_);
      break;
    case 3:
      result.shift_x_ = shift_y_;
      result.shift_y_ = modulo(-shift_x_, ny_);
      break;
    default:
      break;
  }
  return result;
}

LatticeIsometry LatticeIsometry::shifted(int cells_x, int cells_y) const {
  LatticeIsometry result = *this;
  result.shift_x_ = modulo(static_cast<long long>(shift_x_) + cells_x, nx_);
  result.shift_y_ = modulo(static_cast<long long>(shift_y_) + cells_y, ny_);
  return result;
}

LatticeIsometry::Node LatticeIsometry::to_lower(Node own) const {
  const Node turned = turn({nx_ - 1 - own.i, own.j}, quarters_);
  return {modulo(static_cast<long long>(turned.i) + shift_x_, nx_),
          modulo(static_cast<long long>(turned.j) + shift_y_, ny_)};
}

LatticeIsometry::Node LatticeIsometry::to_upper(Node lower) const {
  const Node back = turn({modulo(static_cast<long long>(lower.i) - shift_x_, nx_),
                          modulo(static_cast<long long>(lower.j) - shift_y_, ny_)},
                         (4 - quarters_) % 4);
  return {nx_ - 1 - back.i, back.j};
}

Field LatticeIsometry::to_lower(const Field& own) const {
  Field result(nx_, ny_);
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i) {
      const Node node = to_upper(Node{i, j});
      result(i, j) = own(node.i, node.j);
    }
  return result;
}

Field LatticeIsometry::to_upper(const Field& lower) const {
  Field result(nx_, ny_);
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i) {
      const Node node = to_lower(Node{i, j});
      result(i, j) = lower(node.i, node.j);
    }
  return result;
}

}  // namespace asperity
