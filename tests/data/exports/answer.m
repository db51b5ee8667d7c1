% Answers with the function of MATLAB and Octave, and compares the tables of .mat with those that Python wrote.
arguments = cellfun(@str2double, argv()(end-6:end));
n = arguments(1); width = arguments(2); runs = arguments(3); rounds = arguments(4); has_memory = arguments(5);
addpath(pwd());
looks = fopen('looks', 'rb', 'ieee-le');
out = fopen('octave', 'wb', 'ieee-le');
t = load('controller.mat');
memory = double(t.memories);
% States may be whole numbers or singles; what they are computed with are doubles.
carried = {};
if has_memory
    carried = {memory};
end
[status, u] = controller(ones(3, n), 0, carried{:});
for kind = {'int8', 'single'}
    [of_kind, u_of_kind] = controller(cast(ones(3, n), kind{1}), 0, carried{:});
    assert(isequal(of_kind, status) && isequaln(u_of_kind, u) && isa(u_of_kind, 'double'));
end
for round = 1:rounds
    x = reshape(fread(looks, n * runs, 'double'), n, runs)';
    k = fread(looks, runs, 'uint32');
    if has_memory
        [status, u, memory] = controller(x, k, memory);
    else
        [status, u] = controller(x, k);
    end
    assert(all(all(isnan(u(status ~= 0, :)))) && ! any(any(isnan(u(status == 0, :)))));
    if ! has_memory
        [one, of_one] = controller(x(1, :), k(1));
        assert(one == status(1) && isequaln(of_one, u(1, :)));
    end
    fwrite(out, status, 'uint32');
    fwrite(out, u', 'double');
end
fclose(out);
names = fieldnames(t);
compared = 0;
for i = 1:numel(names)
    file = ['table_', names{i}];
    if exist(file, 'file')
        table = fopen(file, 'rb', 'ieee-le');
        expected = fread(table, Inf, 'double');
        fclose(table);
        assert(isequal(double(t.(names{i})(:)), expected(:)), names{i});
        compared = compared + 1;
    end
end
assert(compared >= 9);
