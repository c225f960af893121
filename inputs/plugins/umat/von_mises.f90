! Von Mises plasticity with linear hardening: radial return with its consistent tangent (Simo and Hughes 1998, box 3.1).
! PROPS: Young's modulus [Pa], Poisson's ratio [-], yield stress [Pa], hardening modulus d(yield)/d(plastic strain) [Pa].
! STATEV(1): equivalent plastic strain. Steps of more than 20 % strain are refused by PNEWDT.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
                predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
                noel, npt, layer, kspt, kstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
                      dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), &
                      dfgrd1(3, 3), sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, pnewdt, celent
  double precision :: mu, bulk, yield, hardening, mean, q, multiplier, shrink, slope, s(ntens), normal(ntens)
  integer :: i, j

  if (maxval(abs(dstran)) > 0.2d0) then
    pnewdt = 0.25d0
    return
  end if
  mu = props(1) / (2 * (1 + props(2)))
  bulk = props(1) / (3 * (1 - 2 * props(2)))
  hardening = props(4)
  yield = props(3) + hardening * statev(1)

  mean = sum(stress(1:3)) / 3 + bulk * sum(dstran(1:3))
  s = stress
  s(1:3) = s(1:3) - sum(stress(1:3)) / 3 + 2 * mu * (dstran(1:3) - sum(dstran(1:3)) / 3)
  s(4:) = s(4:) + mu * dstran(4:)
  q = sqrt(1.5d0 * (sum(s(1:3)**2) + 2 * sum(s(4:)**2)))

  multiplier = 0
  shrink = 1
  slope = 0
  normal = 0
  if (q > yield) then
    multiplier = (q - yield) / (3 * mu + hardening)
    shrink = 1 - 3 * mu * multiplier / q
    slope = 3 * mu / (3 * mu + hardening) - 3 * mu * multiplier / q
    normal = s * sqrt(1.5d0) / q
    statev(1) = statev(1) + multiplier
  end if
  stress = shrink * s
  stress(1:3) = stress(1:3) + mean

  ddsdde = 0
  ddsdde(1:3, 1:3) = bulk - 2 * mu * shrink / 3
  do i = 1, 3
    ddsdde(i, i) = ddsdde(i, i) + 2 * mu * shrink
  end do
  do i = 4, ntens
    ddsdde(i, i) = mu * shrink
  end do
  do j = 1, ntens
    do i = 1, ntens
      ddsdde(i, j) = ddsdde(i, j) - 2 * mu * slope * normal(i) * normal(j)
    end do
  end do
end subroutine umat
