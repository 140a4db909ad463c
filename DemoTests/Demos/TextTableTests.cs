using System;
using System.IO;
using Demos.Terminal;
using Xunit;

namespace DemoTests.Runner;

public class TextTableTests
{
    readonly TextTable table = new("name", ">figure");

    [Fact]
    public void Text_stands_at_the_left_and_figures_at_the_right()
    {
        table.Add("a", "1.5");
        table.Add("longer", "20");
        table.Add("bare");

        Assert.Equal("of two\nname    figure\na          1.5\nlonger      20\nbare\n", Written(writer => table.Write(writer, "of two")));
    }

    [Fact]
    public void A_page_and_a_file_have_the_same_cells()
    {
        table.Add("a|b, \"c\"", "1");
        string path = Path.GetTempFileName();
        try
        {
            table.WriteCsv(path);
            Assert.Equal("name,figure\n\"a|b, \"\"c\"\"\",1\n", File.ReadAllText(path));
        }
        finally
        {
            File.Delete(path);
        }
        Assert.Equal("| name | figure |\n| --- | ---: |\n| a\\|b, \"c\" | 1 |\n", Written(table.WriteMarkdown));
    }

    [Fact]
    public void Rows_have_no_more_cells_than_there_are_columns() => Assert.Throws<ArgumentException>(() => table.Add("a", "b", "c"));

    static string Written(Action<TextWriter> write)
    {
        using var writer = new StringWriter { NewLine = "\n" };
        write(writer);
        return writer.ToString();
    }
}
