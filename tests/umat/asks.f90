! Linear elasticity that asks for what else a UMAT is given; PROPS(3) says what.
!   1 the yield stress PROPS(4) is put into STATEV(1) at the very first increment, von Mises with hardening PROPS(5)
!   2 neo-Hookean from DFGRD1                3 stiffness that grows with the depth below COORDS(2) = 0
!   4 STATEV past its end   5 STRESS past its end   6 DDSDDE past its end   7 STATEV before its begin, far past it: 8
!   9 STATEV(1:6) is the stress so far, which the law turns by DROT itself; it fails where that is not STRESS
!  10 STATEV: KSTEP, KINC, NOEL, NPT, TIME(1), TIME(2), CELENT, COORDS(1), COORDS(2)
!  11 PREDEF   12 TEMP   13 DFGRD0 is DFGRD1 of the step before, kept in STATEV(1:9)
subroutine asks(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
                predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
                noel, npt, layer, kspt, kstep, kinc)
  implicit none
  character(len=*) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(*), statev(*), ddsdde(ntens, *), ddsddt(ntens), drplde(ntens), stran(ntens), dstran(ntens), &
                      time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), sse, &
                      spd, scd, rpl, drpldt, dtime, temp, dtemp, pnewdt, celent
  double precision :: lambda, mu, s(6), p, q, more, theta, t(3, 3), j
  integer :: i, mode, first(6) = (/1, 2, 3, 1, 1, 2/), second(6) = (/1, 2, 3, 2, 3, 3/)

  mode = nint(props(3))
  mu = props(1) / (2 * (1 + props(2)))
  if (mode == 3) mu = mu * (1 - 0.1d0 * coords(2))
  lambda = 2 * mu * props(2) / (1 - 2 * props(2))
  ddsdde(:, 1:ntens) = 0
  ddsdde(1:3, 1:3) = lambda
  do i = 1, ntens
    ddsdde(i, i) = ddsdde(i, i) + merge(2 * mu, mu, i <= 3)
  end do
  if (mode == 9) then
    do i = 1, ntens
      t(first(i), second(i)) = statev(i)
      t(second(i), first(i)) = statev(i)
    end do
    if (ntens == 4) t(3, 1:2) = 0
    if (ntens == 4) t(1:2, 3) = 0
    t = matmul(drot, matmul(t, transpose(drot)))
    do i = 1, ntens
      if (kinc > 1 .and. abs(t(first(i), second(i)) - stress(i)) > 1d-9 * maxval(abs(t))) pnewdt = 0.5d0
    end do
  end if
  if (mode == 1 .and. kstep == 1 .and. kinc == 1) statev(1) = props(4)

  stress(1:ntens) = stress(1:ntens) + matmul(ddsdde(:, 1:ntens), dstran)

  select case (mode)
  case (1)
    p = sum(stress(1:3)) / 3
    s(1:ntens) = stress(1:ntens)
    s(1:3) = s(1:3) - p
    q = sqrt(1.5d0 * (sum(s(1:3)**2) + 2 * sum(s(4:ntens)**2)))
    if (q > statev(1)) then
      more = (q - statev(1)) / (3 * mu + props(5))
      theta = 1 - 3 * mu * more / q
      ddsdde(1:3, 1:3) = lambda + 2 * mu * (1 - theta) / 3
      do i = 1, ntens
        ddsdde(i, i) = merge(lambda + 2 * mu * (1 - theta) / 3 + 2 * mu * theta, mu * theta, i <= 3)
      end do
      do i = 1, ntens
        ddsdde(i, 1:ntens) = ddsdde(i, 1:ntens) - 3 * mu / q**2 * (3 * mu / (3 * mu + props(5)) - 1 + theta) * s(i) * s(1:ntens)
      end do
      stress(1:ntens) = s(1:ntens) * (1 - 3 * mu * more / q)
      stress(1:3) = stress(1:3) + p
      statev(1) = statev(1) + props(5) * more
    end if
  case (2)
    t = matmul(dfgrd1, transpose(dfgrd1))
    j = dfgrd1(1, 1) * (dfgrd1(2, 2) * dfgrd1(3, 3) - dfgrd1(2, 3) * dfgrd1(3, 2)) &
        - dfgrd1(1, 2) * (dfgrd1(2, 1) * dfgrd1(3, 3) - dfgrd1(2, 3) * dfgrd1(3, 1)) &
        + dfgrd1(1, 3) * (dfgrd1(2, 1) * dfgrd1(3, 2) - dfgrd1(2, 2) * dfgrd1(3, 1))
    do i = 1, ntens
      stress(i) = mu / j * t(first(i), second(i))
      if (i <= 3) stress(i) = stress(i) - mu / j + lambda * log(j) / j
    end do
  case (4)
    statev(1:nstatv + 60) = 1
  case (5)
    stress(ntens + 1) = 0
  case (6)
    ddsdde(1, ntens + 1) = 0
  case (7)
    statev(0) = 1
  case (8)
    statev(nstatv + 1000000) = 1
  case (9)
    statev(1:ntens) = stress(1:ntens)
  case (10)
    statev(1:9) = (/dble(kstep), dble(kinc), dble(noel), dble(npt), time(1), time(2), celent, coords(1), coords(2)/)
  case (11)
    stress(1) = stress(1) * (1 + predef(1))
  case (12)
    stress(1:3) = stress(1:3) + 1d3 * (temp + dtemp)
  case (13)
    if (kinc > 1 .and. maxval(abs(reshape(dfgrd0, (/9/)) - statev(1:9))) > 1d-12) pnewdt = 0.5d0
    statev(1:9) = reshape(dfgrd1, (/9/))
  end select
end subroutine asks
