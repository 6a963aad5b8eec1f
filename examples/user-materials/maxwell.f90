! SPDX-License-Identifier: Apache-2.0
! A material law of a user's in Fortran: a viscoelastic solid in rate form with one relaxation time. The deviator of the
! Cauchy stress is s + h, with  ds = 2 mu_long dev d,  dh = 2 mu_decaying dev d - h/time dt, and the mean stress is
! kappa times the sum of the volume strains; d in axes that rotate with the material.
!
! Build:  gfortran -O3 -march=native -shared -fPIC piola_material.f90 maxwell.f90 -o maxwell.so
module maxwell
  use, intrinsic :: iso_c_binding
  use piola_material
  implicit none
  type(piola_parameter), save, target :: parameters(4)
  type(piola_history), save, target :: history(6)
  type(piola_law), save, target :: law
contains
  integer(c_int) function update(at) bind(c)
    type(piola_points), intent(in) :: at
    real(c_double), pointer :: c(:), stress(:, :), h(:, :)
    real(c_double) :: d(6), mean, volume, left, grown
    integer :: p, k
    call c_f_pointer(at%parameters, c, [4])
    call c_f_pointer(at%stress, stress, [at%stride, 6])
    call c_f_pointer(at%history, h, [at%stride, 6])
    left = exp(-at%dt / c(4))
    grown = 1
    if (at%dt > 1e-6_c_double * c(4)) grown = (1 - left) * c(4) / at%dt
    do p = 1, at%count
      d = piola_strain_increment(at, p)
      volume = d(1) + d(2) + d(3)
      mean = (stress(p, 1) + stress(p, 2) + stress(p, 3)) / 3 + c(1) * volume
      d(1:3) = d(1:3) - volume / 3
      do k = 1, 6
        ! The part of the stress that does not decay is what the decaying part h leaves.
        stress(p, k) = stress(p, k) - h(p, k) + 2 * c(2) * d(k)
        h(p, k) = left * h(p, k) + grown * 2 * c(3) * d(k)
        stress(p, k) = stress(p, k) + h(p, k)
      end do
      stress(p, 1:3) = stress(p, 1:3) - sum(stress(p, 1:3)) / 3 + mean
    end do
    update = 0
  end function update

  type(c_ptr) function piola_materials(interface_version, count) bind(c)
    integer(c_int), value :: interface_version
    integer(c_int), intent(out) :: count
    character(len=2), parameter :: axes(6) = ['11', '22', '33', '12', '23', '13']
    integer :: k
    count = 1
    call set(parameters(1), 'bulk_modulus', 'Pa', 'bulk modulus')
    call set(parameters(2), 'shear_modulus', 'Pa', 'shear modulus after a long time')
    call set(parameters(3), 'decaying_modulus', 'Pa', 'shear modulus that decays')
    call set(parameters(4), 'relaxation_time', 's', 'time in which it decays to 1/e')
    do k = 1, 6
      history(k)%name = piola_text('decaying_stress_' // axes(k))
      history(k)%unit = piola_text('Pa')
    end do
    law%name = piola_text('maxwell')
    law%about = piola_text('viscoelastic solid with one relaxation time')
    law%stress = PIOLA_COROTATED_CAUCHY
    law%parameter_count = 4
    law%parameters = c_loc(parameters)
    law%history_count = 6
    law%history = c_loc(history)
    law%update = c_funloc(update)
    piola_materials = c_loc(law)
    if (interface_version /= PIOLA_MATERIAL_INTERFACE) piola_materials = c_null_ptr
  end function piola_materials

  subroutine set(parameter, name, unit, meaning)
    type(piola_parameter), intent(inout) :: parameter
    character(len=*), intent(in) :: name, unit, meaning
    parameter%name = piola_text(name)
    parameter%unit = piola_text(unit)
    parameter%meaning = piola_text(meaning)
    parameter%least = tiny(1.0_c_double)
  end subroutine set
end module maxwell
