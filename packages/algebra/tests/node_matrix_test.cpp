#include "algebra/tests/node_matrix_cases.hpp"

namespace mudline {
namespace {

TEST(NodeMatrix, MultipliesAndProjectsAsItsMatrixDoes) { cases::check_node_matrix(); }

}  // namespace
}  // namespace mudline
