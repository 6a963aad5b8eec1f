! SPDX-License-Identifier: Apache-2.0
! The interface piola_material.h for Fortran. Compile it with the law; the names are those of the header.
module piola_material
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: PIOLA_MATERIAL_INTERFACE = 1
  integer(c_int), parameter :: PIOLA_FIRST_PIOLA = 1, PIOLA_COROTATED_CAUCHY = 2
  integer(c_int), parameter :: PIOLA_ELASTIC = 1, PIOLA_YIELDS = 2, PIOLA_ONE_THREAD = 4

  type, bind(c) :: piola_parameter
    type(c_ptr) :: name = c_null_ptr, unit = c_null_ptr, meaning = c_null_ptr
    real(c_double) :: least = -huge(1.0_c_double), most = huge(1.0_c_double)
    real(c_double) :: preset = transfer(-2251799813685248_c_int64_t, 1.0_c_double)  ! NaN: the case must give it
  end type piola_parameter

  type, bind(c) :: piola_history
    type(c_ptr) :: name = c_null_ptr, unit = c_null_ptr
    real(c_double) :: start = 0
  end type piola_history

  type, bind(c) :: piola_points
    integer(c_int) :: count, stride
    real(c_double) :: time, dt, density
    type(c_ptr) :: parameters, F_old, F_new, U_old, U_new, stress, energy, history, sound_speed
  end type piola_points

  type, bind(c) :: piola_law
    integer(c_int) :: interface_version = PIOLA_MATERIAL_INTERFACE
    type(c_ptr) :: name = c_null_ptr, about = c_null_ptr
    integer(c_int) :: stress = PIOLA_FIRST_PIOLA, properties = 0, parameter_count = 0
    type(c_ptr) :: parameters = c_null_ptr
    integer(c_int) :: history_count = 0
    type(c_ptr) :: history = c_null_ptr
    type(c_funptr) :: check = c_null_funptr, start = c_null_funptr, update = c_null_funptr
  end type piola_law

contains
  ! A text for C. The memory is never freed, as Piola needs it to the end.
  type(c_ptr) function piola_text(text)
    character(len=*), intent(in) :: text
    character(kind=c_char), pointer :: kept(:)
    integer :: k
    allocate (kept(len(text) + 1))
    do k = 1, len(text)
      kept(k) = text(k:k)
    end do
    kept(len(text) + 1) = c_null_char
    piola_text = c_loc(kept(1))
  end function piola_text

  ! See piola_strain.h. p counts from 1.
  function piola_strain_increment(at, p) result(d)
    type(piola_points), intent(in) :: at
    integer, intent(in) :: p
    integer, parameter :: full(3, 3) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3], [3, 3])
    real(c_double), pointer :: before(:, :), after(:, :)
    real(c_double) :: d(6), change(3, 3), m(3, 3), cofactor(3, 3), l(3, 3)
    integer :: i, j
    call c_f_pointer(at%U_old, before, [at%stride, 6])
    call c_f_pointer(at%U_new, after, [at%stride, 6])
    do j = 1, 3
      do i = 1, 3
        change(i, j) = after(p, full(i, j)) - before(p, full(i, j))
        m(i, j) = 0.5_c_double * (after(p, full(i, j)) + before(p, full(i, j)))
      end do
    end do
    cofactor(:, 1) = cross(m(:, 2), m(:, 3))
    cofactor(:, 2) = cross(m(:, 3), m(:, 1))
    cofactor(:, 3) = cross(m(:, 1), m(:, 2))
    l = matmul(change, cofactor) / dot_product(m(:, 1), cofactor(:, 1))
    d = [l(1, 1), l(2, 2), l(3, 3), 0.5_c_double * (l(1, 2) + l(2, 1)), 0.5_c_double * (l(2, 3) + l(3, 2)), &
         0.5_c_double * (l(1, 3) + l(3, 1))]
  end function piola_strain_increment

  pure function cross(a, b)
    real(c_double), intent(in) :: a(3), b(3)
    real(c_double) :: cross(3)
    cross = [a(2) * b(3) - a(3) * b(2), a(3) * b(1) - a(1) * b(3), a(1) * b(2) - a(2) * b(1)]
  end function cross
end module piola_material
