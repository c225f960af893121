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
  include 'arguments.inc'
  integer :: i
  ddsdde = 0
  do i = 1, ntens
    ddsdde(i, i) = props(1)
  end do
  stress = stress + props(1) * dstran
  call sinv(stress, statev(1), statev(2), ndi, nshr)
  call sprinc((/3d0, 1d0, 2d0, 0d0, 0d0, 0d0/), statev(3), 1, 3, 3)
end subroutine umat
