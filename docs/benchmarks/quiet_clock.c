// Time of a parallel run as a quiet machine would show it, on one that is not: the processor time of each rank between its MPI calls, and at every
// collective call the latest rank's. What ranks wait for each other is so in it, what they spin and what other programs take is not; the network costs nothing,
// and ranks that wait for messages from one rank to another only meet at the next collective call.
//
//     mpicc -O1 -fPIC -shared -w -o quiet_clock.so docs/benchmarks/quiet_clock.c -ldl
//     QUIET_CLOCK=times.txt mpiexec -n 2 -x QUIET_CLOCK -x LD_PRELOAD=$PWD/quiet_clock.so mudline run deck.xml
//
// appends a line per rank: processor time, work (the part outside MPI) and clock, in seconds. Open MPI on x86-64 or arm64, C and Fortran.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double mark, work, now;
static int depth, on;

static double processor_time(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}
static void enter(void) {
  if (depth++ > 0 || !on) return;
  const double spent = processor_time() - mark;
  work += spent;
  now += spent;
}
static void leave(void) {
  if (--depth == 0) mark = processor_time();
}
static void meet(MPI_Comm comm) {
  if (depth > 1 || !on || comm == MPI_COMM_SELF || comm == MPI_COMM_NULL) return;
  double latest;
  PMPI_Allreduce(&now, &latest, 1, MPI_DOUBLE, MPI_MAX, comm);
  now = latest;
}

typedef long Word;  // an argument of any type that goes in a register
#define DECLARED Word a0, Word a1, Word a2, Word a3, Word a4, Word a5, Word a6, Word a7, Word a8, Word a9, Word a10, Word a11
#define PASSED a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11
#define CALL(Result, name)                                      \
  static Result (*next)();                                      \
  if (!next) next = (Result(*)())dlsym(RTLD_NEXT, name)
#define C_CALL(Name, at_start)                                  \
  Word wrapped_##Name(DECLARED) __asm__("MPI_" #Name);          \
  Word wrapped_##Name(DECLARED) {                               \
    CALL(Word, "PMPI_" #Name);                                  \
    enter();                                                    \
    at_start;                                                   \
    const Word result = next(PASSED);                           \
    leave();                                                    \
    return result;                                              \
  }
#define FORTRAN_CALL(name, at_start)                            \
  void mpi_##name##_(DECLARED) {                                \
    CALL(void, "mpi_" #name "_");                               \
    enter();                                                    \
    at_start;                                                   \
    next(PASSED);                                               \
    leave();                                                    \
  }
#define COLLECTIVE(Name, name, comm) C_CALL(Name, meet((MPI_Comm)comm)) FORTRAN_CALL(name, meet(MPI_Comm_f2c(*(MPI_Fint*)comm)))
#define OTHER(Name, name) C_CALL(Name, ) FORTRAN_CALL(name, )

COLLECTIVE(Allreduce, allreduce, a5)
COLLECTIVE(Bcast, bcast, a4)
COLLECTIVE(Reduce, reduce, a6)
COLLECTIVE(Barrier, barrier, a0)
COLLECTIVE(Gather, gather, a7)
COLLECTIVE(Gatherv, gatherv, a8)
COLLECTIVE(Allgather, allgather, a6)
COLLECTIVE(Allgatherv, allgatherv, a7)
COLLECTIVE(Alltoall, alltoall, a6)
COLLECTIVE(Alltoallv, alltoallv, a8)
COLLECTIVE(Scan, scan, a5)
COLLECTIVE(Scatter, scatter, a7)
COLLECTIVE(Scatterv, scatterv, a8)
COLLECTIVE(Reduce_scatter, reduce_scatter, a5)
OTHER(Send, send) OTHER(Ssend, ssend) OTHER(Rsend, rsend) OTHER(Bsend, bsend) OTHER(Recv, recv) OTHER(Sendrecv, sendrecv)
OTHER(Isend, isend) OTHER(Issend, issend) OTHER(Irsend, irsend) OTHER(Ibsend, ibsend) OTHER(Irecv, irecv)
OTHER(Wait, wait) OTHER(Waitall, waitall) OTHER(Waitany, waitany) OTHER(Waitsome, waitsome)
OTHER(Test, test) OTHER(Testany, testany) OTHER(Testall, testall) OTHER(Probe, probe) OTHER(Iprobe, iprobe)
C_CALL(File_open, ) C_CALL(File_close, ) C_CALL(File_set_view, ) C_CALL(File_sync, )
C_CALL(File_write_at, ) C_CALL(File_write_at_all, ) C_CALL(File_read_at, ) C_CALL(File_read_at_all, )

int MPI_Init(int* count, char*** words) {
  const int result = PMPI_Init(count, words);
  on = 1;
  mark = processor_time();
  return result;
}
int MPI_Init_thread(int* count, char*** words, int wanted, int* given) {
  const int result = PMPI_Init_thread(count, words, wanted, given);
  on = 1;
  mark = processor_time();
  return result;
}
int MPI_Finalize(void) {
  enter();
  meet(MPI_COMM_WORLD);
  on = 0;
  int rank, ranks;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  FILE* file = fopen(getenv("QUIET_CLOCK") ? getenv("QUIET_CLOCK") : "/dev/stderr", "a");
  fprintf(file, "rank %d of %d: processor time %.2f, work %.2f, clock %.2f\n", rank, ranks, processor_time(), work, now);
  fclose(file);
  return PMPI_Finalize();
}
