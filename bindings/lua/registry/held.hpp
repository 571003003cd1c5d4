// SPDX-License-Identifier: GPL-3.0-or-later
// A function with its captures. std::function would instantiate ten functions for each of thousands of
// options and fields.
#pragma once

#include <concepts>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace asperity::lua {

template <class Signature>
class Held;

template <class Result, class... Given>
class Held<Result(Given...)> {
 public:
  Held() = default;
  // Small captures stay inside, others shared between copies.
  template <class Function>
  requires(!std::same_as<Function, Held>) Held(Function function) {
    if constexpr (std::is_trivially_copyable_v<Function> && sizeof(Function) <= sizeof inside_) {
      ::new (static_cast<void*>(inside_)) Function(function);
      call_ = [](const Held& held, Given... given) -> Result {
        return (*std::launder(reinterpret_cast<const Function*>(held.inside_)))(
            std::forward<Given>(given)...);
      };
    } else {
      shared_ = std::make_shared<const Function>(std::move(function));
      call_ = [](const Held& held, Given... given) -> Result {
        return (*static_cast<const Function*>(held.shared_.get()))(std::forward<Given>(given)...);
      };
    }
  }

  explicit operator bool() const { return call_ != nullptr; }
  Result operator()(Given... given) const { return call_(*this, std::forward<Given>(given)...); }

 private:
  Result (*call_)(const Held&, Given...) = nullptr;
  alignas(void*) unsigned char inside_[6 * sizeof(void*)] = {};
  std::shared_ptr<const void> shared_{};
};

}  // namespace asperity::lua
