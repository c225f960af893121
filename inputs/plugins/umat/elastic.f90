! Isotropic linear elasticity as a UMAT. PROPS: Young's modulus [Pa], Poisson's ratio [-]. No STATEV needed; where there
! are some, the first counts the steps.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
                predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
                noel, npt, layer, kspt, kstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
                      dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), &
                      dfgrd1(3, 3), sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, pnewdt, celent
  double precision :: lambda, mu
  integer :: i

  mu = props(1) / (2 * (1 + props(2)))
  lambda = 2 * mu * props(2) / (1 - 2 * props(2))
  ddsdde = 0
  ddsdde(1:ndi, 1:ndi) = lambda
  do i = 1, ndi
    ddsdde(i, i) = lambda + 2 * mu
  end do
  do i = ndi + 1, ntens
    ddsdde(i, i) = mu
  end do
  stress = stress + matmul(ddsdde, dstran)
  if (nstatv > 0) statev(1) = statev(1) + 1
end subroutine umat
