#!/usr/bin/env bash
# Makes one report of each kind from what the repository ships, and the JSON beside it. Usage: reports.sh PROGRAM FOLDER
set -euo pipefail
program=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
cd "$(dirname "$0")/../.."
profile=robots/abb_irb120_thesis.yaml

# a status of 1 is an answer, too
say() { "$program" "$@" || [ $? -eq 1 ]; }

# programs
say compensate programs/rapid/olp/in/Deburr.mod --profile $profile -o "$out/Deburr.mod" \
  --report "$out/compensate.html" --json > "$out/compensate.json"
say check programs/rapid/olp/in/Deburr.mod --profile $profile --cell tests/browser/cell.yaml \
  --report "$out/check.html" --json > "$out/check.json"
sed '/name: table/s/z_mm: -60/z_mm: 230/' tests/browser/cell.yaml > "$out/crowded.yaml"
say check programs/rapid/olp/in/Deburr.mod --profile $profile --cell "$out/crowded.yaml" \
  --report "$out/collision.html" --json > "$out/collision.json"
say compensate programs/krl/cam/in/pocket.src --profile programs/krl/profile.yaml -o "$out/pocket.src" \
  --report "$out/krl.html" --json > "$out/krl.json"
say check programs/rapid/rail/in/Beam.mod --profile programs/rapid/rail/profile.yaml \
  --report "$out/rail.html" --json > "$out/rail.json"
say check programs/krl/positioner/in/pipe.src --profile programs/krl/positioner/profile.yaml \
  --report "$out/positioner.html" --json > "$out/positioner.json"

# measurements: the shipped robot measured by `simulate`, with two more errors than its profile tells
sed 's/^  effects:$/&\n    - {effect: joint_harmonic, joint: 4, order: 1, cos_deg: 0.03, sin_deg: 0.02}\n    - {effect: joint_scale, joint: 1, ratio: 0.0004}/' \
  $profile > "$out/real.yaml"
{ sed '/^  effects:$/,$d' $profile; echo '  effects: []'; } > "$out/nominal.yaml"
say plan --profile $profile --count 60 --candidates 1000 --starts 2 -o "$out/joints.csv" --program "$out/joints.mod" \
  --report "$out/plan.html" --json > "$out/plan.json"
say plan --profile $profile --count 40 --candidates 200 --starts 1 --seed 7 -o "$out/others.csv" -q
say simulate --profile "$out/real.yaml" --joints "$out/joints.csv" -o "$out/m.csv" --noise-mm 0.03 --seed 1 -q
say simulate --profile $profile --joints "$out/joints.csv" -o "$out/fit.csv" --noise-mm 0.03 --seed 2 -q
say simulate --profile $profile --joints "$out/others.csv" -o "$out/v.csv" --noise-mm 0.03 --seed 3 -q
say calibrate --profile "$out/nominal.yaml" --measurements "$out/fit.csv" -o "$out/calibrated.yaml" \
  --report "$out/calibrate.html" --json > "$out/calibrate.json"
say validate --profile "$out/calibrated.yaml" --measurements "$out/v.csv" \
  --report "$out/validate.html" --json > "$out/validate.json"
say diagnose --profile $profile --measurements "$out/m.csv" -o "$out/better.yaml" \
  --report "$out/diagnose.html" --json > "$out/diagnose.json"

# frames
say register docs/measuring/nominal.csv docs/measuring/probed.csv --at 1000,0,0 \
  --report "$out/register.html" --json > "$out/register.json"
say handeye docs/measuring/robot.csv docs/measuring/board.csv --setup eye-in-hand \
  --report "$out/handeye.html" --json > "$out/handeye.json"
say hexapod docs/measuring/lengths.csv --report "$out/hexapod.html" --json > "$out/hexapod.json"
say register docs/measuring/drawing.csv docs/measuring/scan.csv --icp \
  --report "$out/icp.html" --json > "$out/icp.json"
say hexapod --taught docs/measuring/taught.csv --base-mm 300.01,299.98,300.02 -o "$out/device.yaml" \
  --report "$out/taught.html" --json > "$out/taught.json"
say hexapod --reach --base-mm 300,300,300 --tool-mm 150,150,150 --frame "$out/device.yaml" --profile robots/fanuc_lrmate200ic.yaml \
  --report "$out/reach.html" --json > "$out/reach.json"
say axes docs/measuring/sweeps.csv --profile $profile --report "$out/axes.html" --json > "$out/axes.json"

# names that are markup, and no target at all
evil="$out/<img src=x onerror=alert(1)>'\"&.csv"
printf 'id,x_mm,y_mm,z_mm,qx,qy,qz,qw\n"</script><script>alert(2)</script>",400,50,300,0,1,0,0\n"=1+1 \303\274 \342\200\250",400,-50,300,0,1,0,0\n' > "$evil"
say compensate "$evil" --profile $profile -o "$out/evil-out.csv" --tool artifact \
  --report "$out/evil.html" --json > "$out/evil.json"
printf 'MODULE empty\n  PROC main()\n    TPWrite "nothing moves";\n  ENDPROC\nENDMODULE\n' > "$out/empty.mod"
say compensate "$out/empty.mod" --profile $profile -o "$out/empty-out.mod" \
  --report "$out/empty.html" --json > "$out/empty.json"

# ten thousand targets
{
  printf 'MODULE many\n  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n  PROC main()\n    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,z10,artifact;\n'
  awk 'BEGIN { for (k = 0; k < 10000; k++) { t = k / 100; printf "    MoveL [[%.3f,%.3f,%.3f],[0.000000,0.000000,1.000000,0.000000],[%d,0,%d,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z0,artifact;\n", 380 + (20 + k / 250) * cos(t), y = (20 + k / 250) * sin(t), 260 + k / 500, -(y < 0), -(y < 0) } }'
  printf '  ENDPROC\nENDMODULE\n'
} > "$out/many.mod"
say compensate "$out/many.mod" --profile $profile -o "$out/many-out.mod" --report "$out/many.html" -q
