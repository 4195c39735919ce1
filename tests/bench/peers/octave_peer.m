% Times one method in Octave: octave-cli octave_peer.m JOB DATA REPETITIONS
%
% JOB is lssvf or srivc; DATA and what is printed are those of numpy_peer.py, and so are the methods: see
% identification.py for the conventions. Filtering is Octave's built-in filter.
1;

function R = matrix_exponential (M)
  squarings = max (0, ceil (log2 (norm (M, Inf) / 0.5)));
  M /= 2^squarings;
  bound = last = norm (M, Inf);
  term = M;
  R = eye (rows (M)) + M;
  k = 1;
  while bound > 1e-17
    k++;
    bound *= last / k;
    term = term * M / k;
    R += term;
  end
  for k = 1:squarings
    R *= R;
  end
end

% The filters p^i/A, i < n, and p^i B/A^2 sampled exactly, for a polynomial A with the given poles.
function S = derivative_filters (A, poles, Ts, B)
  n = numel (A) - 1;
  stage = [-A(2:end); eye(n - 1, n)];
  if isempty (B)
    M = stage;
  else
    drive = zeros (n);
    drive(1, n - numel (B) + 1:n) = B;
    M = [stage, zeros(n); drive, stage];
  end
  states = rows (M);
  M(states + 2, states + 2) = 0;
  M(1, states + 1) = M(states + 1, states + 2) = 1;
  X = matrix_exponential (M * Ts);
  S.n = n;
  S.F = X(1:states, 1:states);
  S.held = X(1:states, states + 1);
  S.ramp = X(1:states, states + 2) / Ts;
  S.denominator = real (poly (exp (poles * Ts)));
end

% Numerators of the filters whose impulse responses are start, F start, ...
function b = numerators (F, start, order, denominator)
  R = zeros (numel (start), order);
  R(:, 1) = start;
  for k = 2:order
    R(:, k) = F * R(:, k - 1);
  end
  b = R * toeplitz ([denominator(1); zeros(order - 1, 1)], denominator(1:order));
end

% Columns [-p^(n-1) y_f .. -y_f, p^m u_f .. u_f, p^n y_f] with x_f = x/E: y on straight lines, u held.
function Phi = regression (E, S, u, y, m)
  n = S.n;
  F = S.F(1:n, 1:n);
  ramp = S.ramp(1:n);
  held = S.held(1:n);
  b = ramp * S.denominator;
  b(:, 2:end) += numerators (F, F * ramp + held - ramp, n, S.denominator);
  start = -numerators (F, ramp, n, S.denominator) * y(1);  % the ramp begins at the first sample, not before it
  Phi = zeros (numel (u), n + m + 2);
  highest = y;
  for k = 1:n
    filtered = filter (b(k, :), S.denominator, y, start(k, :)');
    highest -= E(k + 1) * filtered;
    Phi(:, k) = -filtered;
  end
  b = numerators (F, held, n, S.denominator);
  for k = n - m:n
    Phi(:, m + 1 + k) = filter ([0, b(k, :)], S.denominator, u);
  end
  Phi(:, end) = highest;
end

function theta = lssvf (u, y, n, m, Ts, cutoff)
  poles = -cutoff * ones (n, 1);
  E = poly (poles);
  Phi = regression (E, derivative_filters (E, poles, Ts, []), u, y, m);
  P = Phi' * Phi;
  theta = P(1:end - 1, 1:end - 1) \ P(1:end - 1, end);
end

function [A, poles] = reflected (a)
  A = [1, a(:)'];
  poles = roots (A);
  unstable = real (poles) > 0;
  if any (unstable)
    poles(unstable) = -conj (poles(unstable));
    A = real (poly (poles));
  end
end

function [theta, iteration] = srivc (u, y, n, m, Ts, cutoff, tolerance, most)
  theta = lssvf (u, y, n, m, Ts, cutoff);
  for iteration = 1:most
    [A, poles] = reflected (theta(1:n));
    S = derivative_filters (A, poles, Ts, theta(n + 1:end)');
    Phi = regression (A, S, u, y, m);
    denominator = conv (S.denominator, S.denominator);
    b = numerators (S.F, S.held, 2 * n, denominator)(n + 1:end, :);
    Z = zeros (numel (u), n);
    for k = 1:n
      Z(:, k) = -filter ([0, b(k, :)], denominator, u);
    end
    P = [Z' * Phi; Phi(:, n + 1:end - 1)' * Phi];
    last = theta;
    theta = P(:, 1:end - 1) \ P(:, end);
    if max (abs ((theta - last) ./ theta)) < tolerance
      break
    end
  end
end

function largest = difference_from_reference (folder)
  expected = fileread (fullfile (folder, "reference_8digits.csv"));
  largest = 0;
  for dataset = {"sys2_noisefree", "sys2_s0.2_seed1"}
    data = dlmread (fullfile (folder, [dataset{1} ".csv"]), ",", 1, 0);
    found.lssvf_yfoh = lssvf (data(:, 2), data(:, 3), 2, 0, 0.01, 2);
    found.srivc_yfoh_ivexact = srivc (data(:, 2), data(:, 3), 2, 0, 0.01, 2, 1e-10, 50);
    for [theta, estimator] = found
      values = regexp (expected, ["\\n" dataset{1} "," estimator ",\\w+,([^,]+)"], "tokens");
      largest = max (largest, max (abs (theta ./ str2double ([values{:}](:)) - 1)));
    end
  end
end

[name, file, repetitions] = argv (){end - 2:end};
reference = fullfile (fileparts (mfilename ("fullpath")), "..", "..", "reference", "data");
difference = difference_from_reference (reference);
printf ("difference\t%.3g\n", difference);
if ! (difference < 1e-7)
  error ("octave_peer.m: the estimates are not those of the reference data, so its times would mean nothing.");
end
stream = fopen (file);
data = reshape (fread (stream, Inf, "double"), [], 2);
fclose (stream);
u = data(:, 1);
y = data(:, 2);
work = struct ("lssvf", @() lssvf (u, y, 2, 0, 0.01, 3), ...
               "srivc", @() srivc (u, y, 2, 0, 0.01, 3, 1e-6, 50)).(name);
printf ("theta%s\n", sprintf ("\t%.17g", work ()));
times = zeros (str2double (repetitions), 1);
for k = 1:numel (times)
  start = tic;
  work ();
  times(k) = toc (start);
end
printf ("seconds\t%.9g\n", median (times));
