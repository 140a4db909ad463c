using Xunit;

namespace DemoTests.Support;

/// <summary>Tests that read what the whole process does, such as the memory that all of its threads allocate: they run with no others.</summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public class AloneCollection
{
    public const string Name = "alone";
}
