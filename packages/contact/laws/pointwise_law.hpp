#pragma once

#include <Kokkos_Core.hpp>

#include <type_traits>

#include "materials/pointwise.hpp"

namespace mudline {

/// What many points ask a law at once.
template <class Question, class Answer>
struct LawList {
  Kokkos::View<const char*> asked;  // 0: this point does not ask
  Kokkos::View<const Question*> questions;
  Kokkos::View<Answer*> answers;
};

/// What runs at every point: asks a trivially copyable law, answer = law(question).
template <class Law, class Question, class Answer>
struct AskAtPoint {
  static_assert(std::is_trivially_copyable_v<Law>, "a law is captured by value in kernels");
  Law law;
  LawList<Question, Answer> list;
  CaughtInKernel* caught;
  KOKKOS_FUNCTION void operator()(int i) const {
    if (!list.asked(i)) return;
    CaughtInKernel::run(caught, [&] {
      list.answers(i) = law(list.questions(i));
      return true;
    });
  }
};

/// Asks it everywhere, in a kernel.
template <class Law, class Question, class Answer>
void ask_in_kernel(const Law& law, const LawList<Question, Answer>& list) {
  CaughtInKernel thrown;
  Kokkos::parallel_for("contact law", Kokkos::RangePolicy<>(0, list.asked.extent(0)),
                       AskAtPoint<Law, Question, Answer>{law, list, &thrown});
  thrown.rethrow();
}

/// Asks a function of the host, one point after the other.
template <class Law, class Question, class Answer>
void ask_on_host(const Law& law, const LawList<Question, Answer>& list) {
  for (std::size_t i = 0; i < list.asked.extent(0); ++i)
    if (list.asked(i)) list.answers(i) = law(list.questions(i));
}

}  // namespace mudline
