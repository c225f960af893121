#pragma once

#include <type_traits>
#include <utility>

namespace mudline {

class Section;

/// Whether an expression, given as an alias like OwnCheck, compiles for a type: for members that a type may have.
template <template <class> class Expression, class T, class = void>
inline constexpr bool compiles = false;
template <template <class> class Expression, class T>
inline constexpr bool compiles<Expression, T, std::void_t<Expression<T>>> = true;

/// The member by which a registered type or a law checks rules across its parameters.
template <class T>
using OwnCheck = decltype(std::declval<T&>().check(std::declval<const Section&>()));

}  // namespace mudline
