#pragma once

// The only place that names Tpetra's template arguments: always the defaults, so that Trilinos' explicit
// instantiations serve and compile time stays low.
#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector.hpp>

namespace mudline {

using Teuchos::RCP;
using Teuchos::rcp;

using Comm = Teuchos::Comm<int>;
using Map = Tpetra::Map<>;
using LocalOrdinal = Map::local_ordinal_type;
using GlobalOrdinal = Map::global_ordinal_type;
using Node = Map::node_type;
using Import = Tpetra::Import<>;
using Vector = Tpetra::Vector<>;
using MultiVector = Tpetra::MultiVector<>;
using CrsMatrix = Tpetra::CrsMatrix<>;
using Operator = Tpetra::Operator<>;

}  // namespace mudline
