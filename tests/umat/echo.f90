! Linear elasticity that checks what it is given and fails (PNEWDT) where that is not what it expects. STATEV: 1 end time of
! the last step, 2-7 the stress it returned (a tensor that mudline rotates), 8-13 the strain, 14 the step, 15 first letter.
subroutine echo(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, dtemp, &
                predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
                noel, npt, layer, kspt, kstep, kinc)
  implicit none
  character(len=*) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
                      dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), &
                      dfgrd1(3, 3), sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, pnewdt, celent
  double precision :: lambda, mu, kept(ntens), longest
  integer :: i

  kept = statev(8:13)
  kept(4:) = 2 * kept(4:)
  longest = props(3)
  if (ndi /= 3 .or. nshr /= 3 .or. ntens /= 6 .or. nstatv /= 15 .or. nprops /= 3) pnewdt = 0.5d0
  if (len(cmname) /= 80 .or. cmname(2:) /= 'cho clay') pnewdt = 0.5d0
  if (abs(drot(1, 1) - 1) + abs(drot(3, 3) - 1) + abs(drot(1, 2)) > 0) pnewdt = 0.5d0  ! its tensors are turned already
  if (abs(time(2) - statev(1)) > 1d-9 * (1 + time(2)) .or. time(1) /= time(2)) pnewdt = 0.5d0
  if (statev(14) > 0 .and. maxval(abs(stress - statev(2:7))) > 1d-9 * maxval(abs(stress))) pnewdt = 0.5d0
  if (maxval(abs(stran - kept)) > 1d-12) pnewdt = 0.5d0
  if (dtime > longest) pnewdt = 0.5d0
  if (pnewdt < 1) return

  mu = props(1) / (2 * (1 + props(2)))
  lambda = 2 * mu * props(2) / (1 - 2 * props(2))
  ddsdde = 0
  ddsdde(1:3, 1:3) = lambda
  do i = 1, 3
    ddsdde(i, i) = lambda + 2 * mu
    ddsdde(i + 3, i + 3) = mu
  end do
  stress = stress + matmul(ddsdde, dstran)
  statev(1) = time(2) + dtime
  statev(2:7) = stress
  statev(8:13) = stran + dstran
  statev(11:13) = statev(11:13) / 2
  statev(14) = statev(14) + 1
  statev(15) = ichar(cmname(1:1))
end subroutine echo
