# SPDX-License-Identifier: Apache-2.0
# Piola in a container: Debian 12 and its packages only. The first stage builds the packages, the second installs them.
#
#   docker build -t piola .
#   docker run --rm -v "$PWD:/data" --user "$(id -u):$(id -g)" piola run case.toml
#   docker run --rm piola describe library
FROM debian:12-slim AS build
COPY . /piola
WORKDIR /piola
RUN tools/make_packages

FROM debian:12-slim
COPY --from=build /piola/build/packages/*.deb /packages/
RUN apt-get update \
 && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /packages/piola_*.deb /packages/python3-piola_*.deb \
 && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["piola"]
CMD ["--help"]
