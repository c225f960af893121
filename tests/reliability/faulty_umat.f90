! A UMAT with every fault that one may have: PROPS(1) chooses it, from the second half of the run on. 0: linear elastic.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
                predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
                noel, npt, layer, kspt, kstep, kinc)
  use, intrinsic :: ieee_arithmetic
  use, intrinsic :: iso_c_binding
  implicit none
  character(len=*) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
                      dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), &
                      dfgrd1(3, 3), sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, pnewdt, celent
  integer :: i
  integer, volatile :: zero
  integer, pointer :: nowhere
  double precision :: nan

  ddsdde = 0
  ddsdde(1:3, 1:3) = 2d6 / 3
  do i = 1, 3
    ddsdde(i, i) = 2d6 / 3 + 2d6
    ddsdde(i + 3, i + 3) = 1d6
  end do
  stress = stress + matmul(ddsdde, dstran)
  if (time(1) < 0.4d0) return

  zero = 0
  nan = ieee_value(nan, ieee_quiet_nan)
  select case (nint(props(1)))
  case (1)
    stop
  case (2)
    stop 'the clay is too soft'
  case (3)
    error stop 3
  case (4)
    call exit(0)
  case (5)
    call abort()
  case (6)
    zero = 7 / zero
  case (7)
    call c_f_pointer(transfer(8_c_intptr_t, c_null_ptr), nowhere)
    nowhere = 1
  case (8)
    stress(2) = nan
  case (9)
    statev(1) = nan
  case (10)
    ddsdde(2, 2) = nan
  case (11)
    pnewdt = 0.5d0
  case (12)
    call deeper(zero)
  case (13)
    open (unit=77, file='no such table', status='old')
  case (14)
    call put(statev, nstatv + 3)
  case (15)
    call put(stress, 0)
  case (16)
    stress = stress + predef(1)
  end select

contains

  subroutine put(a, i)  ! where the compiler does not see how long the array is
    double precision :: a(*)
    integer :: i
    a(i) = 1
  end subroutine put

  recursive subroutine deeper(depth)
    integer, volatile :: depth
    integer, volatile :: here(1000)
    here = depth
    call deeper(here(1))
    depth = depth + here(2)
  end subroutine deeper

end subroutine umat
