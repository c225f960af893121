#pragma once

#include <vector>

#include "framework/nodal_exchange.hpp"
#include "framework/state.hpp"

namespace mudline {

/// A continuous field recovered from samples in the elements of a part of the mesh: around every vertex a polynomial is
/// fitted, by least squares, to the samples of the elements that touch it (Zienkiewicz & Zhu 1992); an element takes
/// the mean of its corners' polynomials, weighted by their linear shape functions. Polynomials of the fitted degree are
/// reproduced exactly. A vertex with too few samples, as most on the boundary have, takes the polynomials of its
/// neighbours. In the plane and in space, on any number of ranks: the normal equations of a vertex are sums over
/// elements.
class PatchRecovery {
 public:
  /// x: where the nodes are; degree: 1 or 2; columns: values of a sample.
  PatchRecovery(const Mesh& mesh, const NodalExchange& exchange, const ConstCoordinateView& x, int degree, int columns);

  /// The element, by its corners' local nodes, to which the samples added next belong.
  void begin_element(const int* corners, int count);
  void add(const Point& x, const double* values);
  /// After the last sample. Collective.
  void fit();

  /// Values of all columns at a place of an element; N: linear shape functions of its corners there. gradients:
  /// (column, direction), where asked for.
  void evaluate(const int* corners, int count, const double* N, const Point& x, double* values,
                double* gradients = nullptr) const;

 private:
  /// 1, the offsets from the vertex, half their squares and their products: a polynomial's coefficients are its value,
  /// slopes and curvatures there.
  void basis(int vertex, const Point& x, double* powers) const;
  /// The polynomial of one vertex with another's as its centre.
  void recentre(int from, int to, double* coefficients) const;
  /// From a row of moments; returns how many terms the samples resolve.
  int solve(const double* moments, double* coefficients) const;
  template <int n>
  int solve_terms(const double* moments, double* coefficients) const;
  /// Adds up rows of `width` values by vertex over the ranks that share it. Collective.
  void sum_shared(std::vector<double>& rows, int width) const;
  /// Vertices without a good fit of their own take those of their neighbours, no farther than two elements.
  void spread(std::vector<char>& fitted);
  double* polynomial(int vertex) { return &polynomials_[static_cast<std::size_t>(vertex) * terms_ * columns_]; }
  const double* polynomial(int vertex) const {
    return &polynomials_[static_cast<std::size_t>(vertex) * terms_ * columns_];
  }

  const Mesh& mesh_;
  const NodalExchange& exchange_;
  ConstCoordinateView x_;
  int dimension_, degree_, columns_, terms_, width_;
  std::vector<int> vertex_, node_;   // (local node) number among the vertices, -1; (vertex)
  std::vector<int> corners_, ends_;  // vertices of all elements; where each ends
  std::vector<double> moments_;      // (vertex, number of samples, upper triangle, right sides)
  std::vector<double> polynomials_;  // (vertex, column, term)
};

}  // namespace mudline
