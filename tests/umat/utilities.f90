! Linear elasticity that calls the utility routines of Abaqus; PROPS(3) says what.
!   0 nothing   1 SINV, SPRINC, SPRIND, ROTSIG with NDI, NSHR = PROPS(4:5), the tensor PROPS(6:11) and the rotation
!     PROPS(12:20), results in STATEV(1:44)   2 XIT when half a second is over   3 the same with STDB_ABQERR, LOP = -3
!   4 messages of all other kinds, once   5 SPRINC with LSTR = 3   6 errors without end   7 LOP = 2
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
  implicit none
  include 'arguments.inc'
  double precision :: lambda, mu, s(6), r(3, 3)
  integer :: i, n, k, intv(2), mode
  double precision :: realv(2)
  character(len=8) :: charv(2)
  logical, save :: told = .false.

  mu = props(1) / (2 * (1 + props(2)))
  lambda = 2 * mu * props(2) / (1 - 2 * props(2))
  ddsdde = 0
  ddsdde(1:3, 1:3) = lambda
  do i = 1, ntens
    ddsdde(i, i) = ddsdde(i, i) + merge(2 * mu, mu, i <= 3)
  end do
  stress = stress + matmul(ddsdde, dstran)

  mode = nint(props(3))
  if (mode == 1) then
    n = nint(props(4))
    k = nint(props(5))
    s = props(6:11)
    r = reshape(props(12:20), (/3, 3/))
    call sinv(s, statev(1), statev(2), n, k)
    call sprinc(s, statev(3), 1, n, k)
    call sprinc(s, statev(6), 2, n, k)
    call sprind(s, statev(9), statev(12), 1, n, k)
    call sprind(s, statev(21), statev(24), 2, n, k)
    call rotsig(s, r, statev(33), 1, n, k)
    call rotsig(s, r, statev(39), 2, n, k)
  end if
  intv = (/noel, 42/)
  realv = (/0.5d0, -2d-3/)
  charv = (/'soft    ', 'clay    '/)
  if (mode == 2 .and. time(2) + dtime > 0.51d0) call xit
  if (mode == 3 .and. time(2) + dtime > 0.51d0) call stdb_abqerr(-3, 'no more of %S, %I', intv, realv, charv)
  if (mode == 4 .and. .not. told) then
    call stdb_abqerr(1, 'element %I has %R and %R', intv, realv, charv)
    call stdb_abqerr(-1, '%S %S: 5 % of %I, %I   ', intv, realv, charv)
    call stdb_abqerr(-2, 'not found', intv, realv, charv)
    call stdb_abqerr(-2, 'nor found again', intv, realv, ' ')
    told = .true.
  end if
  if (mode == 5) call sprinc(s, statev(1), 3, 3, 3)
  if (mode == 6) call stdb_abqerr(-2, 'again', intv, realv, charv)
  if (mode == 7) call stdb_abqerr(2, 'what', intv, realv, charv)
end subroutine umat
