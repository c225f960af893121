#pragma once

#include <vector>

#include "framework/nodal_exchange.hpp"
#include "framework/state.hpp"

namespace mudline {

/// A continuous field recovered from samples in the elements of a part of the mesh: around every vertex a polynomial is
/// fitted, by least squares, to the samples of the elements that touch it (Zienkiewicz & Zhu 1992); an element takes
/// the mean of its corners' polynomials, weighted by their linear shape functions. Polynomials of the fitted degree are
/// reproduced exactly. A vertex with too few samples, as most on the boundary have, takes the polynomials of its
/// neighbours. Works in the plane and in space, on any number of ranks: the normal equations of a vertex are sums over
/// elements.
class PatchRecovery {
 public:
  /// x: node coordinates [m]; degree: 1 or 2; columns: number of values per sample.
  PatchRecovery(const Mesh& mesh, const NodalExchange& exchange, const ConstCoordinateView& x, int degree, int columns);

  /// Begins an element, given by the local nodes of its corners; the samples added next belong to it.
  void begin_element(const int* corners, int count);
  void add(const Point& x, const double* values);
  /// Fits the polynomials after the last sample. Collective.
  void fit();

  /// Values of all columns at the position x [m] in an element; N: linear shape functions of its corners there;
  /// gradients: (column, direction) [1/m], if not null.
  void evaluate(const int* corners, int count, const double* N, const Point& x, double* values,
                double* gradients = nullptr) const;

 private:
  /// The monomials: 1, the offsets from the vertex, half their squares and their products. With them the coefficients
  /// of a polynomial are its value, gradient and second derivatives at the vertex.
  void basis(int vertex, const Point& x, double* powers) const;
  /// Changes the centre of a polynomial from one vertex to another.
  void recentre(int from, int to, double* coefficients) const;
  /// Solves for the coefficients from a row of moments; returns how many terms the samples resolve.
  int solve(const double* moments, double* coefficients) const;
  template <int n>
  int solve_terms(const double* moments, double* coefficients) const;
  /// Adds up rows of `width` values by vertex over the ranks that share it. Collective.
  void sum_shared(std::vector<double>& rows, int width) const;
  /// Vertices without a good fit take the polynomials of their neighbours, at most two elements away.
  void spread(std::vector<char>& fitted);
  double* polynomial(int vertex) { return &polynomials_[static_cast<std::size_t>(vertex) * terms_ * columns_]; }
  const double* polynomial(int vertex) const {
    return &polynomials_[static_cast<std::size_t>(vertex) * terms_ * columns_];
  }

  const Mesh& mesh_;
  const NodalExchange& exchange_;
  ConstCoordinateView x_;
  int dimension_, degree_, columns_, terms_, width_;
  std::vector<int> vertex_, node_;   // (local node) vertex number, -1 at other nodes; (vertex) local node
  std::vector<int> corners_, ends_;  // vertices of all elements; end of each element's part
  std::vector<double> moments_;      // (vertex, number of samples, upper triangle, right sides)
  std::vector<double> polynomials_;  // (vertex, column, term)
};

}  // namespace mudline
