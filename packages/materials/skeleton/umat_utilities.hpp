#pragma once

#include <string>
#include <vector>

#include "core/symbol_supply.hpp"

namespace mudline {

/// The utility routines of Abaqus/Standard that UMATs call, by the names that Fortran compilers give them: sinv_,
/// sprinc_, sprind_, rotsig_, xit_, stdb_abqerr_. Arguments and results are those of the Abaqus User Subroutines Guide,
/// "Utility Routines": tensors in the order 11 22 33 12 13 23, of which NDI direct and NSHR shear components are there
/// (the others are 0); LSTR is 1 for stresses and 2 for strains, whose shear is engineering shear.
///
///   SINV         a third of the trace, and sqrt(3/2 S : S) with the deviator S
///   SPRINC       principal values, ascending
///   SPRIND       these with their directions, the rows of AN, which are right-handed
///   ROTSIG       R S R^T
///   XIT          ends the program with exit code 1
///   STDB_ABQERR  LOP = 1 tells a message, -1 warns, -2 warns of an error and counts it, -3 ends the program; %I, %R,
///                %S in the text are the next items of INTV, REALV and CHARV
std::vector<SuppliedFunction> umat_utilities();

/// The law whose subroutine runs, for the messages of the utility routines.
struct UmatCaller {
  std::string law, library;    // CMNAME, name of the file
  int element = 0, point = 0;  // NOEL, NPT

  /// "law 'CLAY' of the library 'clay.so', element 3, point 4"
  std::string text() const;
};

/// While an object of this class lives, the utility routines are called by this law.
class UmatCall {
 public:
  explicit UmatCall(const UmatCaller& caller);
  ~UmatCall();
  UmatCall(const UmatCall&) = delete;
  UmatCall& operator=(const UmatCall&) = delete;
};

/// The number of errors, LOP = -2, that laws have reported on this rank since the last call.
int take_reported_errors();

}  // namespace mudline
