! A UMAT without stiffness to speak of, with a SINV of its own that answers -1 and -2, while SPRINC is the program's.
subroutine sinv(stress, sinv1, sinv2, ndi, nshr)
  implicit none
  integer :: ndi, nshr
  double precision :: stress(ndi + nshr), sinv1, sinv2
  sinv1 = -1
  sinv2 = -2
end subroutine sinv

subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
                temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, &
                celent, dfgrd0, dfgrd1, noel, npt, layer, kspt, kstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kstep, kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), &
                      stran(ntens), dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), &
                      drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, &
                      pnewdt, celent
  integer :: i
  ddsdde = 0
  do i = 1, ntens
    ddsdde(i, i) = props(1)
  end do
  stress = stress + props(1) * dstran
  call sinv(stress, statev(1), statev(2), ndi, nshr)
  call sprinc((/3d0, 1d0, 2d0, 0d0, 0d0, 0d0/), statev(3), 1, 3, 3)
end subroutine umat
