#pragma once
// One visitor made of several lambdas, for std::visit.

namespace sphdrop {

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace sphdrop
