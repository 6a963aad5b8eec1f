c     SPDX-License-Identifier: Apache-2.0
c     A VUMAT with the documented list of arguments: elasticity, von Mises yield, linear isotropic hardening.
c     props: Young's modulus, Poisson's ratio, yield stress, hardening modulus; state: equivalent plastic strain.
      subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     1  lanneal, stepTime, totalTime, dt, cmname, coordMp, charLength,
     2  props, density, strainInc, relSpinInc, tempOld, stretchOld,
     3  defgradOld, fieldOld, stressOld, stateOld, enerInternOld,
     4  enerInelasOld, tempNew, stretchNew, defgradNew, fieldNew,
     5  stressNew, stateNew, enerInternNew, enerInelasNew)
      include 'vaba_param.inc'
      dimension props(nprops), density(nblock), coordMp(nblock, *),
     1  charLength(nblock), strainInc(nblock, ndir+nshr),
     2  relSpinInc(nblock, nshr), tempOld(nblock),
     3  stretchOld(nblock, ndir+nshr),
     4  defgradOld(nblock, ndir+nshr+nshr),
     5  fieldOld(nblock, nfieldv), stressOld(nblock, ndir+nshr),
     6  stateOld(nblock, nstatev), enerInternOld(nblock),
     7  enerInelasOld(nblock), tempNew(nblock),
     8  stretchNew(nblock, ndir+nshr),
     9  defgradNew(nblock, ndir+nshr+nshr)
      dimension fieldNew(nblock, nfieldv),
     1  stressNew(nblock, ndir+nshr), stateNew(nblock, nstatev),
     2  enerInternNew(nblock), enerInelasNew(nblock)
      character*80 cmname
      dimension s(6)
      twomu = props(1) / (1 + props(2))
      alamda = twomu * props(2) / (1 - 2 * props(2))
      do 100 i = 1, nblock
        trace = strainInc(i, 1) + strainInc(i, 2) + strainInc(i, 3)
        do k = 1, 6
          s(k) = stressOld(i, k) + twomu * strainInc(i, k)
          if (k .le. 3) s(k) = s(k) + alamda * trace
        end do
        smean = (s(1) + s(2) + s(3)) / 3
        vmises = sqrt(1.5d0 * ((s(1) - smean)**2 + (s(2) - smean)**2
     1    + (s(3) - smean)**2 + 2 * (s(4)**2 + s(5)**2 + s(6)**2)))
        sigdif = vmises - props(3) - props(4) * stateOld(i, 1)
        deqps = max(0.0d0, sigdif) / (1.5d0 * twomu + props(4))
        factor = 1
        if (deqps .gt. 0) factor = 1 - 1.5d0 * twomu * deqps / vmises
        do k = 1, 6
          stressNew(i, k) = factor * s(k)
          if (k .le. 3) stressNew(i, k) = stressNew(i, k)
     1      + (1 - factor) * smean
        end do
        stateNew(i, 1) = stateOld(i, 1) + deqps
        enerInternNew(i) = enerInternOld(i)
        enerInelasNew(i) = enerInelasOld(i)
        do k = 1, 6
          w = 0.5d0 * (stressOld(i, k) + stressNew(i, k)) / density(i)
     1      * strainInc(i, k)
          if (k .gt. 3) w = 2 * w
          enerInternNew(i) = enerInternNew(i) + w
        end do
  100 continue
      return
      end
