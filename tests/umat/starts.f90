! Linear elasticity that starts as SDVINI and SIGINI say. PROPS: Young's modulus and Poisson's ratio.
!   STATEV: COORDS, NSTATV, NCRDS, NOEL, NPT
!   SIGMA: a unit weight of 9.0 (times the unit of length) under the height 0 vertically, half of it horizontally; in
!   space also a shear stress 13 of 0.2 times the depth
subroutine sdvini(statev, coords, nstatv, ncrds, noel, npt, layer, kspt)
  implicit none
  integer :: nstatv, ncrds, noel, npt, layer, kspt
  double precision :: statev(nstatv), coords(ncrds)
  statev = 0
  statev(1:ncrds) = coords
  statev(4:7) = (/dble(nstatv), dble(ncrds), dble(noel), dble(npt)/)
end subroutine sdvini

subroutine sigini(sigma, coords, ntens, ncrds, noel, npt, layer, kspt, lrebar, names)
  implicit none
  integer :: ntens, ncrds, noel, npt, layer, kspt, lrebar
  double precision :: sigma(ntens), coords(ncrds)
  character(len=80) :: names(2)
  sigma(1:3) = 0.5d0 * 9 * coords(ncrds)
  sigma(ncrds) = 9 * coords(ncrds)
  if (ncrds == 3) sigma(5) = -0.2d0 * coords(3)
  if (lrebar /= 0 .or. names(1) /= ' ' .or. len(names) /= 80) sigma = 1d300
end subroutine sigini

subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
  implicit none
  include 'arguments.inc'
  double precision :: lambda, mu
  integer :: i
  mu = props(1) / (2 * (1 + props(2)))
  lambda = 2 * mu * props(2) / (1 - 2 * props(2))
  ddsdde = 0
  ddsdde(1:ndi, 1:ndi) = lambda
  do i = 1, ntens
    ddsdde(i, i) = ddsdde(i, i) + merge(2 * mu, mu, i <= ndi)
  end do
  stress = stress + matmul(ddsdde, dstran)
end subroutine umat
