#!/usr/bin/env bash
# The whole CI as one local command: everything that a change must pass. Needs the .NET SDK and nothing else.
#
#   ./check.sh            all steps
#
# SCENES=FOLDER runs the .scene files of a folder besides the built-in scenes; without it, and with a scene generator beside the
# repository, those that it writes are run. The last line is "N passed, N failed": tests, scenes and steps, taken from their results.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1

export DOTNET_CLI_TELEMETRY_OPTOUT=1 DOTNET_NOLOGO=1 CI=true
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
passed=0
failed=0
failures=()
names=()
processors="$(getconf _NPROCESSORS_ONLN)"

pass() { passed=$((passed + 1)); }

fail() {
    failed=$((failed + 1))
    failures+=("$1")
    echo "FAILED: $1"
}

await_processor() { while (($(jobs -rp | wc -l) >= processors)); do sleep 0.05; done; }

# begin NAME COMMAND...: runs in the background as soon as a processor is free; settle waits for all and shows them in order, each with
# its time, and its output where it fails.
begin() {
    local id=${#names[@]}
    names+=("$1")
    shift
    rm -f "$work/$id.result"
    await_processor
    {
        local start=$SECONDS status=0
        "$@" > "$work/$id.log" 2>&1 || status=$?
        echo "$status $((SECONDS - start))" > "$work/$id.result"
    } &
}

settle() {
    local id status seconds bad=0
    wait
    for id in "${!names[@]}"; do
        # Who was killed wrote no result.
        read -r status seconds 2> /dev/null < "$work/$id.result" || { status=1 seconds=0; }
        if ((status == 0)); then
            pass
            printf '%-44s passed  %4d s\n' "${names[id]}" "$seconds"
        else
            bad=1
            tail -n 80 "$work/$id.log"
            fail "${names[id]}"
            printf '%-44s FAILED  %4d s\n' "${names[id]}" "$seconds"
        fi
    done
    names=()
    return $bad
}

# step NAME COMMAND...: one result, alone.
step() {
    begin "$@"
    settle
}

finish() {
    if ((failed > 0)); then
        echo
        printf 'failed: %s\n' "${failures[@]}"
    fi
    echo
    printf 'time: %d s\n' "$SECONDS"
    printf '%d passed, %d failed\n' "$passed" "$failed"
    exit $((failed > 0))
}

# Warnings are errors in every project.
build() { dotnet build -c Release -warnaserror; }

pack() {
    local project extension
    for project in BepuUtilities BepuPhysics; do
        dotnet pack "$project" -c Release --no-build --output "$work/packages" || return 1
        for extension in nupkg snupkg; do
            compgen -G "$work/packages/Tootbird.$project.[0-9]*.$extension" || { echo "no $extension of $project"; return 1; }
        done
    done
}

# Reads a counter of a test report.
counter() { grep -o '<Counters [^>]*' "$work/tests/tests.trx" | grep -o " $1=\"[0-9]*\"" | grep -o '[0-9]*' | head -n 1; }

# The tests, by the command of the readme. Each test is a result.
run_tests() {
    local start=$SECONDS log="$work/tests.log" status good bad
    PHYSICS_PACKAGES="$work/packages" dotnet test -c Release --no-build --logger "trx;LogFileName=tests.trx" --results-directory "$work/tests" \
        --blame-hang-timeout 8m --blame-hang-dump-type none > "$log" 2>&1
    status=$?
    if [[ ! -f "$work/tests/tests.trx" ]]; then
        tail -n 80 "$log"
        fail "tests: no report"
        return
    fi
    good=$(counter passed)
    bad=$(($(counter failed) + $(counter error) + $(counter timeout) + $(counter aborted)))
    passed=$((passed + good))
    failed=$((failed + bad))
    if ((bad > 0)); then
        grep -vE '^\s+at |^\[xUnit' "$log" | tail -n 200
        failures+=("$bad tests")
    elif ((status != 0)); then
        tail -n 80 "$log"
        fail "tests: exit status $status"
    elif ((good == 0)); then
        fail "tests: none ran"
    fi
    printf '%-44s %d passed, %d failed  %4d s\n' "tests" "$good" "$bad" $((SECONDS - start))
}

demos=artifacts/bin/Demos/release/Demos.dll
scenes=()

demos() { dotnet "$demos" "$@"; }

# begin_scenes KIND DEMOS SCENE...: runs scenes in the background, in one process that compiles the engine once; each is a result, as if begun by itself.
begin_scenes() {
    local kind="$1" runner="$2" first=${#names[@]} scene
    shift 2
    for scene in "$@"; do
        rm -f "$work/${#names[@]}.result" "$work/${#names[@]}.log"
        names+=("scene $(basename "$scene")$kind")
    done
    await_processor
    {
        id=$first start=$SECONDS
        printf 'run "%s" --steps 20\n' "$@" | dotnet "$runner" batch 2>&1 | while IFS= read -r line; do
            if [[ "$line" =~ ^exit\ status\ ([0-9]+)$ ]]; then
                echo "${BASH_REMATCH[1]} $((SECONDS - start))" > "$work/$id.result"
                id=$((id + 1)) start=$SECONDS
            else
                echo "$line" >> "$work/$id.log"
            fi
        done
    } &
}

run_scenes() {
    local folder="${SCENES:-}" files
    demos list > "$work/list" || { fail "list of scenes"; return; }
    [[ -s "$work/list" ]] || { fail "list of scenes is empty"; return; }
    mapfile -t scenes < <(awk '{ print $1 }' "$work/list")
    begin_scenes "" "$demos" "${scenes[@]}"
    settle
    if [[ -z "$folder" && -f ../shared/tools/make-scenes ]] && command -v python3 > "$work/which"; then
        folder="$work/scenes"
        step "make scenes" python3 ../shared/tools/make-scenes "$folder" || return
    fi
    [[ -n "$folder" ]] || return
    mapfile -t files < <(compgen -G "$folder/*.scene")
    ((${#files[@]} == 0)) || begin_scenes "" "$demos" "${files[@]}"
    settle
}

# The invariants that inner loops rely on: they vanish from release builds, so nothing else ever asks them. They are in the two libraries, which take the
# place of those without in a copy of the tests and of the runner beside them.
checks=artifacts/bin/DemoTests/release_checks
build_with_checks() {
    rm -rf "$checks"
    dotnet build BepuPhysics -c Release -p:Validate=true --no-restore || return 1
    cp -r artifacts/bin/DemoTests/release "$checks" && cp artifacts/bin/BepuPhysics/release_checks/* "$checks"
}

# What adds, removes, moves and calls in all orders; a fault of an inner loop shows here or in a scene. Joints of all types in one tree meet the same
# invariants as hundreds of trees of one type.
test_with_checks() {
    local filter="" name
    for name in DemoTests.Utilities DemoTests.Trees DemoTests.Constraints ScrambleTests UnrelatedBodyTests HistoryTests FallbackTests RandomCalls; do
        filter="${filter:+$filter|}FullyQualifiedName~$name"
    done
    dotnet test DemoTests -c Release -p:Validate=true --no-build --blame-hang-timeout 5m --blame-hang-dump-type none \
        --filter "($filter)&FullyQualifiedName!~It_gains_no_energy"
}

# The analysers have read the same sources in the first build.
run_debug_build() {
    dotnet run -c Debug --project Demos --no-restore --property:RunAnalyzers=false --property:EnforceCodeStyleInBuild=false \
        --property:GenerateDocumentationFile=false -- "$@"
}

# Every benchmark once, in one process: whether it runs, not how fast it is.
run_benchmarks() { dotnet artifacts/bin/Benchmarks/release/Benchmarks.dll smoke; }

step "build" build || finish
step "pack" pack
run_tests
# From here on what uses one processor goes beside the rest.
begin "build with checks" build_with_checks
# White space; style and order are held by the build and by StyleTests.
begin "format" dotnet format whitespace --verify-no-changes --no-restore
begin "benchmarks, once each" run_benchmarks
# Without optimization too, as somebody who looks for a fault would.
begin "scene in a debug build" run_debug_build run pile --steps 5
run_scenes
begin "tests with checks" test_with_checks
((${#scenes[@]} == 0)) || begin_scenes " with checks" "$checks/Demos.dll" "${scenes[@]}"
settle
finish
