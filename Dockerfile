# `docker build --target cli .` is the command alone on an empty image, `--target fleet` the Python package with the fleet.
# Programs are mounted read-only: docker run --rm -v "$PWD:/work:ro" -v "$PWD/out:/out" poseshift compensate …
FROM rust:1.95-alpine AS binary
# the image names the release of its packages
# hadolint ignore=DL3018
RUN apk add --no-cache musl-dev
WORKDIR /source
COPY . .
RUN cargo build --profile dist --locked

FROM scratch AS cli
COPY --from=binary /source/target/dist/poseshift /poseshift
COPY --from=binary /source/LICENSE-APACHE /source/LICENSE-MIT /licences/
USER 65532:65532
WORKDIR /work
ENTRYPOINT ["/poseshift"]

FROM rust:1.95-slim-bookworm AS wheel
# hadolint ignore=DL3008
RUN apt-get update && apt-get install -y --no-install-recommends python3-venv && rm -rf /var/lib/apt/lists/*
RUN python3 -m venv /tools && /tools/bin/pip install --no-cache-dir "maturin>=1.9,<2"
WORKDIR /source
COPY . .
WORKDIR /source/python
RUN /tools/bin/maturin build --profile dist --locked --compression-level 9 --out /dist

FROM python:3.13-slim-bookworm AS fleet
COPY --from=wheel /dist /dist
RUN pip install --no-cache-dir "$(ls /dist/*.whl)[fleet]" && rm -r /dist && useradd --uid 65532 robot
USER 65532
WORKDIR /work
ENTRYPOINT ["poseshift-fleet"]
